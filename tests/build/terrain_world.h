// Hand-made height maps for tests, as a TerrainSource and as a BlockSource; and the nodes of a built terrain.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "build/build_terrain.h"
#include "build/terrain_layout.h"
#include "import/open_terrain.h"
#include "scenefile/scene.h"
#include "worlds/scratch_folder.h"

namespace fb::test {

inline constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

class HandMadeTerrain final : public TerrainSource {
  public:
    HandMadeTerrain(std::uint32_t columns, std::uint32_t rows, std::vector<float> heights,
                    double cellMetres = 1.0)
        : heights_(std::move(heights)) {
        info_.name = "hand-made";
        info_.columns = columns;
        info_.rows = rows;
        info_.cellMetres = glm::dvec2(cellMetres);
        info_.sourceHash = 7;
        EXPECT_EQ(heights_.size(), std::size_t{columns} * rows);
    }
    [[nodiscard]] Result<std::uint64_t> survey() { return surveyTerrain(*this, info_); }
    [[nodiscard]] TerrainInfo& change() { return info_; }
    [[nodiscard]] float at(std::uint32_t c, std::uint32_t r) const {
        return heights_[std::size_t{r} * info_.columns + c];
    }
    std::vector<std::uint8_t> drape;
    mutable int reads = 0;

    [[nodiscard]] const TerrainInfo& info() const override { return info_; }
    [[nodiscard]] Result<void> readHeights(const TakeHeights& take) const override {
        ++reads;
        for (std::uint32_t r = 0; r < info_.rows; ++r) {
            if (Result<void> taken =
                    take(r, std::span(heights_).subspan(std::size_t{r} * info_.columns, info_.columns));
                !taken) {
                return taken;
            }
        }
        return {};
    }
    [[nodiscard]] Result<void> readDrape(const TakeTexels& take) const override { return take(0, drape); }

  private:
    TerrainInfo info_;
    std::vector<float> heights_;
};

// Heights in quarters of a metre with holes, but for the first cell, and cliffs where `steep`.
inline HandMadeTerrain randomTerrain(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed,
                                     double holeShare, bool steep = false) {
    Random random(seed);
    std::vector<float> heights(std::size_t{columns} * rows);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double x = static_cast<double>(i % columns), y = static_cast<double>(i / columns);
        const double wave = 3.0 * std::sin(0.23 * x) * std::cos(0.31 * y);
        heights[i] =
            static_cast<float>(std::floor(4.0 * (wave + random.uniform(0.0, steep ? 40.0 : 1.5))) / 4.0);
    }
    const auto holes = static_cast<std::size_t>(holeShare * 20.0);
    for (std::size_t k = 0; k < holes; ++k) {
        const std::uint64_t c = random.index(columns), r = random.index(rows), size = 1 + random.index(6);
        for (std::uint64_t y = r; y < std::min<std::uint64_t>(rows, r + size); ++y) {
            for (std::uint64_t x = c; x < std::min<std::uint64_t>(columns, c + size); ++x)
                if (x > 1 || y > 1) heights[y * columns + x] = kHole;
        }
    }
    return HandMadeTerrain(columns, rows, std::move(heights));
}

// A scene of the terrain alone.
class TerrainAlone final : public BlockSource {
  public:
    explicit TerrainAlone(const TerrainSource& terrain) : terrain_(terrain) { info_.name = "alone"; }
    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return 0; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t) const override { return failure({}, {}, "no block"); }
    [[nodiscard]] const TerrainSource* terrain() const override { return &terrain_; }

  private:
    const TerrainSource& terrain_;
    SourceInfo info_;
};

inline BuildSettings terrainSettings(std::int64_t desired) {
    BuildSettings settings;
    settings.desiredTriangles = desired;
    return settings;
}

inline std::string buildLine(HandMadeTerrain& terrain, const std::filesystem::path& folder,
                             std::int64_t desired = 16) {
    if (Result<std::uint64_t> surveyed = terrain.survey(); !surveyed) return surveyed.error().oneLine();
    Result<BuildReport> built = buildScene(TerrainAlone(terrain), terrainSettings(desired), folder, {});
    return built ? "built" : built.error().oneLine();
}

// A node's vertices in metres and its triangles, skirts apart.
struct ShownNode {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> surface, skirts;
};
inline ShownNode shownNode(const Scene& scene, NodeId node) {
    ShownNode shown;
    Result<std::vector<std::uint8_t>> bytes = readPayload(scene, node);
    EXPECT_TRUE(bytes);
    Result<NodeData> data = parsePayload(*bytes, "node");
    EXPECT_TRUE(data);
    const BlockGrid& grid = scene.hierarchy.grids[scene.hierarchy.block[node]];
    for (const NodeVertex& v : data->mesh.vertices)
        shown.vertices.push_back(grid.origin + grid.step * glm::dvec3(v.x, v.y, v.z));
    const std::vector<std::uint32_t>& i = data->mesh.indices;
    for (std::uint32_t t = 0; t < i.size() / 3; ++t) {
        (data->mesh.isSkirt(t) ? shown.skirts : shown.surface)
            .emplace_back(i[t * 3], i[t * 3 + 1], i[t * 3 + 2]);
    }
    return shown;
}

}  // namespace fb::test
