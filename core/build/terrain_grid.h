// A terrain on its block's integer grid, once, so that tiles meet exactly. Comes from TerrainInfo.
// Plan coordinates are whole grid units from the first sample: `across` by column, `down` by row, both
// rising; a height is a whole number of units above the grid's origin. at() turns them into the block's
// coordinates. Errors of a terrain are distances from the map on this grid: rounding onto it is at most half
// a step.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "import/terrain_source.h"
#include "scenefile/hierarchy.h"

namespace fb {

struct TerrainGrid {
    BlockGrid grid;
    UpAxis up = UpAxis::y;
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::int32_t> across, down;
    std::int32_t firstAcross = 0, firstDown = 0;  // the first sample on the block's grid
    double zeroHeight = 0.0;                      // grid units; what height 0 is

    // Rounds to the nearest step; halves upward.
    [[nodiscard]] std::int32_t heightUnits(float metres) const {
        return static_cast<std::int32_t>(
            std::floor(zeroHeight + static_cast<double>(metres) / grid.step + 0.5));
    }
    [[nodiscard]] glm::ivec3 at(std::int32_t a, std::int32_t d, std::int32_t height) const {
        return up == UpAxis::y ? glm::ivec3(firstAcross + a, height, firstDown + d)
                               : glm::ivec3(firstAcross + a, firstDown - d, height);
    }
    // A direction given as (across, up, down).
    [[nodiscard]] glm::vec3 direction(const glm::vec3& v) const {
        return up == UpAxis::y ? v : glm::vec3(v.x, -v.z, v.y);
    }
};

// Refused: maps so large, or heights so far apart, that neighbouring columns would fall onto one step of the
// grid.
[[nodiscard]] Result<TerrainGrid> makeTerrainGrid(const TerrainInfo& info);

}  // namespace fb
