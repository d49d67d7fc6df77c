// The heights of a terrain while it is built: a pyramid of samples on the block's grid, in work files beside
// the scene, so that any window of any level is read at will whatever the map's size and format. Level 0 is
// the map. Sample (i, j) of level k is sample (i, j) * 2^k of the map, the last column and row always the
// map's last; where that one is unknown, the mean of the known samples beside it. A cell of level k is there
// when any cell of the map inside it is. Point samples are sound: coarse nodes take only their shape from
// higher levels, their errors are measured against level 0 (terrain_error.h), and where tiles meet both see
// the same samples.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "build/square_file.h"
#include "build/terrain_grid.h"

namespace fb {

// A sample: its height in grid units, whether it is known, and whether the cell to the right of and below it
// is there.
struct HeightSample {
    std::uint32_t bits = 0;

    static constexpr std::uint32_t kKnown = 1u << 30, kCell = 1u << 31;
    [[nodiscard]] std::int32_t height() const { return static_cast<std::int32_t>(bits & 0xffffffu); }
    [[nodiscard]] bool known() const { return (bits & kKnown) != 0; }
    [[nodiscard]] bool cell() const { return (bits & kCell) != 0; }
};

using HeightWindow = ValueWindow<HeightSample>;

class TerrainHeights {
  public:
    // Reads the map through once and writes the work files into `folder`. `levels`: how many are wanted.
    [[nodiscard]] static Result<TerrainHeights> make(const TerrainSource& source, const TerrainGrid& grid,
                                                     std::uint32_t levels,
                                                     const std::filesystem::path& folder);

    [[nodiscard]] std::uint32_t columns(std::uint32_t level) const { return levels_[level].columns(); }
    [[nodiscard]] std::uint32_t rows(std::uint32_t level) const { return levels_[level].rows(); }
    // Safe from several threads. The window says what is wanted; samples beyond the map are unknown.
    [[nodiscard]] Result<void> read(std::uint32_t level, HeightWindow& window) const {
        return levels_[level].read(window);
    }

  private:
    [[nodiscard]] Result<void> addCoarser(const std::filesystem::path& folder);

    std::vector<SquareFile<HeightSample>> levels_;
};

}  // namespace fb
