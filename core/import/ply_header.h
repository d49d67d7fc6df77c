// The header of a PLY file: which elements follow, with which properties of which types.
// Comes from read_ply.cpp and goes back there.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "import/mesh_file.h"

namespace fb {

enum class PlyFormat : std::uint8_t { ascii, littleEndian, bigEndian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t sizeOf(PlyType type);
[[nodiscard]] constexpr bool isReal(PlyType type) {
    return type >= PlyType::float32;
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool isList = false;
    PlyType countType = PlyType::uint8;  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string> textureFiles;  // of "comment TextureFile NAME", in order
    std::size_t bodyOffset = 0;
    std::uint64_t lines = 0;  // of the header: for messages about an ascii body
};

// Counts are only read here; the reader of the body holds them against the bytes that follow.
[[nodiscard]] Result<PlyHeader> parsePlyHeader(const MeshBytes& input);

}  // namespace fb
