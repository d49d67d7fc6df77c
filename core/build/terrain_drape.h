// The picture on a terrain while it is built: a pyramid of halved pictures in work files, each texel the mean
// of the four below it, in sRGB bytes as the mip levels of decodeNode are. Comes from
// TerrainSource::readDrape; a node takes a rectangle of one level: a leaf the picture's own texels, the nodes
// above it one level coarser each.
#pragma once

#include <filesystem>
#include <vector>

#include "build/square_file.h"
#include "import/terrain_source.h"

namespace fb {

struct DrapeTexel {
    std::uint8_t r = 0, g = 0, b = 0;
};
static_assert(sizeof(DrapeTexel) == 3);

class TerrainDrape {
  public:
    TerrainDrape() = default;  // no picture
    [[nodiscard]] static Result<TerrainDrape> make(const TerrainSource& source,
                                                   const std::filesystem::path& folder);

    [[nodiscard]] bool isThere() const { return !levels_.empty(); }
    [[nodiscard]] std::uint32_t levels() const { return static_cast<std::uint32_t>(levels_.size()); }
    // RGB. Beyond the picture its edge goes on. Safe from several threads.
    [[nodiscard]] Result<Image> read(std::uint32_t level, std::int64_t column, std::int64_t row, int width,
                                     int height) const;

  private:
    [[nodiscard]] Result<void> addCoarser(const std::filesystem::path& folder);

    std::vector<SquareFile<DrapeTexel>> levels_;
};

}  // namespace fb
