// Caps of everything that a scene file may claim. They are far above what a build makes and low enough that a
// damaged count cannot make the reader allocate without bound. Readers and writers hold to the same ones.
#pragma once

#include <cstdint>

namespace fb {

inline constexpr std::uint32_t kMaxNodes = 1u << 24;
inline constexpr std::uint32_t kMaxBlocks = 100'000;  // a pack's name has five digits
inline constexpr std::uint32_t kMaxLevel = 63;
inline constexpr std::uint32_t kMaxNodeVertices = 1u << 24;
inline constexpr std::uint32_t kMaxNodeTriangles = 1u << 24;
inline constexpr std::uint32_t kMaxTextureSide = 16'384;
inline constexpr std::uint32_t kGridCells = 1u << 24;  // vertex coordinates are below: exact as floats
// A grid's step is 2^k metres with k between these, so that step * coordinate neither over- nor underflows as
// float.
inline constexpr int kMinGridExponent = -60;
inline constexpr int kMaxGridExponent = 40;
inline constexpr double kMaxCoordinateMetres = 1.0e12;
inline constexpr std::uint64_t kMaxSceneTomlBytes = 16u << 20;

}  // namespace fb
