// Caps on what an import believes of a file. They bound the work and the memory that damaged or hostile input
// can ask for; real models stay far below them. Counts inside a file are held against the bytes left as well.
#pragma once

#include <cstdint>

namespace fb {

inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t{8} << 30;
inline constexpr std::uint64_t kMaxMaterialFileBytes = std::uint64_t{64} << 20;
inline constexpr std::uint64_t kMaxTextureFileBytes = std::uint64_t{1} << 30;

// Vertices and triangles of one file; also keeps sums of a few of them inside 32 bits.
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 29;

// Larger coordinates are no lengths in metres; the areas computed from them would overflow.
inline constexpr double kMaxCoordinate = 1e15;

// A scene numbers its packs with five digits.
inline constexpr std::uint64_t kMaxBlocks = 99999;

// Height maps and the pictures on them: longest side. They are read in strips and need not fit into memory.
inline constexpr int kMaxRowsSide = 1 << 22;

// Textures held whole: longest side, pixels (1 GiB as RGBA), and how many bytes of pixels one encoded byte may stand
// for. Deflate reaches 1,032, a progressive JPEG of one colour somewhat more.
inline constexpr int kMaxTextureSide = 32768;
inline constexpr std::uint64_t kMaxTexturePixels = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxTextureInflation = 4096;

// Textures that are read part by part, of formats whose decoders need no more than a few rows or tiles.
inline constexpr int kMaxTiledTextureSide = 1 << 17;
inline constexpr std::uint64_t kMaxTiledTexturePixels = std::uint64_t{1} << 34;

}  // namespace fb
