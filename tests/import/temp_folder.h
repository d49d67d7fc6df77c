// A scratch folder to write files into, and short ways to read meshes from files written into it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "import/import_files.h"
#include "worlds/scratch_folder.h"

namespace fb::test {

class TempFolder : public ScratchFolder {
  public:
    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        return file;
    }
};

// Little-endian bytes of numbers, one after another.
class Bytes {
  public:
    template <class T>
    requires std::is_arithmetic_v<T> Bytes& add(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (bigEndian_) std::reverse(raw, raw + sizeof(T));
        text_.append(raw, sizeof(T));
        return *this;
    }
    Bytes& add(std::string_view text) {
        text_ += text;
        return *this;
    }
    explicit Bytes(bool bigEndian = false) : bigEndian_(bigEndian) {}
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    static_assert(std::endian::native == std::endian::little);
    bool bigEndian_;
    std::string text_;
};

struct Read {
    SourceBlock block;
    ImportReport report;
    std::string error;  // empty when it worked

    [[nodiscard]] const SourceMesh& mesh() const { return block.mesh; }
    [[nodiscard]] glm::dvec3 corner(std::size_t triangle, int i) const {
        return block.mesh.positions[block.mesh.triangles[triangle][i]];
    }
};

inline Read read(const std::filesystem::path& file, const ImportOptions& options = {}) {
    Read result;
    Result<SourceBlock> block = readMeshFile(file, options, result.report);
    if (block) {
        result.block = std::move(*block);
    } else {
        result.error = block.error().oneLine();
    }
    return result;
}

inline Read readText(const std::string& name, std::string_view content) {
    const TempFolder folder;
    return read(folder.write(name, content));
}

inline double triangleArea(const SourceMesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a = mesh.positions[t.x];
    return 0.5 * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
}

inline double area(const SourceMesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) sum += triangleArea(mesh, t);
    return sum;
}

// Six times the volume inside, positive if all triangles face outward.
inline double sixVolumes(const SourceMesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
    }
    return sum;
}

// A cube of side 2 around the origin: eight corners, six squares facing outward, as indices from 0.
//
//      7------6        y
//     /|     /|        |
//    3------2 |        +--x
//    | 4----|-5       /
//    |/     |/       z     (0 to 3 in front, z = 1)
//    0------1
inline constexpr double kCubeCorners[8][3] = {{-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1},
                                              {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
inline constexpr unsigned kCubeSquares[6][4] = {{0, 1, 2, 3}, {5, 4, 7, 6}, {4, 0, 3, 7},
                                                {1, 5, 6, 2}, {3, 2, 6, 7}, {4, 5, 1, 0}};
inline constexpr unsigned kCubeTriangles[12][3] = {{0, 1, 2}, {0, 2, 3}, {5, 4, 7}, {5, 7, 6},
                                                   {4, 0, 3}, {4, 3, 7}, {1, 5, 6}, {1, 6, 2},
                                                   {3, 2, 6}, {3, 6, 7}, {4, 5, 1}, {4, 1, 0}};

// 12 triangles on 8 corners, area 6 * 4, volume 8, facing outward.
inline void expectCube(const Read& read, std::size_t vertices = 8) {
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(read.mesh().positions.size(), vertices);
    ASSERT_EQ(read.mesh().triangles.size(), 12u);
    EXPECT_EQ(read.mesh().materials.size(), 12u);
    EXPECT_EQ(read.report.sourceTriangles, 12u);
    EXPECT_DOUBLE_EQ(area(read.mesh()), 24.0);
    EXPECT_DOUBLE_EQ(sixVolumes(read.mesh()), 48.0);
}

inline bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

// How many warnings contain `part`.
inline int warningsWith(const ImportReport& report, std::string_view part) {
    return static_cast<int>(
        std::count_if(report.warnings.begin(), report.warnings.end(),
                      [&](const std::string& warning) { return contains(warning, part); }));
}

}  // namespace fb::test
