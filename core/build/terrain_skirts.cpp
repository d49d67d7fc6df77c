#include "build/terrain_skirts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace fb {
namespace {

// Vertices of the tile that lie on one of its sides, by their place along it.
std::unordered_map<std::int32_t, std::uint32_t> verticesAlong(const TileMesh& tile, std::size_t side,
                                                              std::uint32_t count) {
    std::unordered_map<std::int32_t, std::uint32_t> along;
    for (std::uint32_t i = 0; i < count; ++i) {
        const TileVertex& v = tile.vertices[i];
        const bool on = side == 0   ? v.row == tile.firstRow
                        : side == 1 ? v.column == tile.firstColumn
                        : side == 2 ? v.column == tile.lastColumn
                                    : v.row == tile.lastRow;
        if (on) along.emplace(tile.sides[side].vertical ? v.down : v.across, i);
    }
    return along;
}

}  // namespace

Result<double> hangSkirts(const TerrainBuild& build, TileMesh& tile) {
    double widest = 0.0;
    const auto surface = static_cast<std::uint32_t>(tile.vertices.size());
    for (std::size_t s = 0; s < 4; ++s) {
        const std::vector<BorderPoint>& line = tile.borders[s];
        Result<BorderGaps> gaps = borderGaps(build.heights, build.grid, build.layout, tile.sides[s], line);
        if (!gaps) return passOn(gaps);
        widest = std::max(widest, gaps->widest);
        const std::uint8_t inner = s < 2 ? kSideAfter : kSideBefore;
        const auto hangs = [&](std::size_t stretch) {
            return stretch + 1 < line.size() && (line[stretch].sides & inner) != 0 &&
                   gaps->reach[stretch] < kNoNeighbour;
        };
        const std::unordered_map<std::int32_t, std::uint32_t> along = verticesAlong(tile, s, surface);
        // As seen from outside, a skirt goes to the right along the line above and the one to the right.
        const bool forward = s == 1 || s == 3;
        std::unordered_map<std::uint32_t, std::uint32_t> hanging;
        const auto below = [&](std::size_t point) {
            const std::uint32_t top = along.at(line[point].place);
            const auto [found, isNew] =
                hanging.emplace(top, static_cast<std::uint32_t>(tile.vertices.size()));
            if (isNew) {
                TileVertex vertex = tile.vertices[top];
                double reach = vertex.height;
                if (hangs(point)) reach = std::min(reach, gaps->reach[point]);
                if (point > 0 && hangs(point - 1)) reach = std::min(reach, gaps->reach[point - 1]);
                vertex.height = static_cast<std::int32_t>(std::floor(reach)) - 1;
                tile.vertices.push_back(vertex);
            }
            return found->second;
        };
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            if (!hangs(i)) continue;
            const std::uint32_t a = along.at(line[i].place), b = along.at(line[i + 1].place);
            const std::uint32_t c = below(i), d = below(i + 1);
            const glm::uvec3 first = forward ? glm::uvec3(a, c, d) : glm::uvec3(a, d, c);
            const glm::uvec3 second = forward ? glm::uvec3(a, d, b) : glm::uvec3(a, b, d);
            tile.triangles.push_back(first);
            tile.triangles.push_back(second);
        }
    }
    return widest;
}

}  // namespace fb
