// One pass over a height map: what is known of it, and a walk on it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "import/open_terrain.h"

namespace fb {
namespace {

constexpr double kWalkMetres = 120.0,
                 kWalkShare = 0.4;  // side of the square, and at most this part of the map
constexpr double kWalkStepMetres = 2.0;

struct PlanPoint {
    double column = 0.0, row = 0.0;
};

std::vector<PlanPoint> squareWay(const TerrainInfo& info) {
    const glm::dvec2 size(info.columns - 1, info.rows - 1);
    const double side = std::min(
        {kWalkMetres, kWalkShare * size.x * info.cellMetres.x, kWalkShare * size.y * info.cellMetres.y});
    const glm::dvec2 half = 0.5 * side / info.cellMetres, middle = 0.5 * size;
    const double step = std::max(kWalkStepMetres, std::max(info.cellMetres.x, info.cellMetres.y));
    const int steps = std::clamp(static_cast<int>(side / step), 1, 256);
    const glm::dvec2 corners[5] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
    std::vector<PlanPoint> way;
    for (int leg = 0; leg < 4; ++leg) {
        for (int i = 0; i < steps; ++i) {
            const glm::dvec2 at =
                corners[leg] + (corners[leg + 1] - corners[leg]) * (static_cast<double>(i) / steps);
            way.push_back({middle.x + at.x * half.x, middle.y + at.y * half.y});
        }
    }
    way.push_back(way.front());
    return way;
}

}  // namespace

Result<std::uint64_t> surveyTerrain(const TerrainSource& source, TerrainInfo& info) {
    if (info.columns < 2 || info.rows < 2) {
        return failure(info.name, {},
                       "has " + std::to_string(info.columns) + " x " + std::to_string(info.rows) +
                           " heights, which span no cell",
                       "at least 2 x 2 make a terrain");
    }
    float low = std::numeric_limits<float>::infinity(), high = -low;
    std::uint64_t unknown = 0, cells = 0;
    std::vector<std::uint8_t> above(info.columns, 0), known(info.columns, 0);
    Result<void> read = source.readHeights([&](std::uint32_t, std::span<const float> rows) -> Result<void> {
        for (std::size_t at = 0; at < rows.size(); at += info.columns) {
            for (std::size_t i = 0; i < info.columns; ++i) {
                const float height = rows[at + i];
                known[i] = height == height ? 1 : 0;
                if (known[i] == 0) {
                    ++unknown;
                    continue;
                }
                low = std::min(low, height);
                high = std::max(high, height);
                if (i > 0 && (known[i - 1] & above[i] & above[i - 1]) != 0) ++cells;
            }
            above.swap(known);
        }
        return {};
    });
    if (!read) return passOn(read);
    if (unknown == std::uint64_t{info.columns} * info.rows) {
        return failure(info.name, {}, "has no height that is known",
                       "--no-data names the value that means nothing");
    }
    if (cells == 0) return failure(info.name, {}, "has no cell whose four heights are known");
    info.lowestMetres = low;
    info.highestMetres = high;
    return unknown;
}

Result<std::optional<WalkHint>> walkOnTerrain(const TerrainSource& source) {
    const TerrainInfo& info = source.info();
    const std::vector<PlanPoint> way = squareWay(info);
    std::vector<float> heights(way.size(), std::numeric_limits<float>::quiet_NaN());
    std::vector<std::size_t> order(way.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto rowOf = [&](std::size_t i) { return static_cast<std::uint32_t>(way[i].row); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rowOf(a) < rowOf(b); });
    std::size_t next = 0;
    std::vector<float> last;  // the row before the ones at hand
    // Bilinear; the cell's two triangles lie within a fraction of its height around that.
    const auto blend = [&](std::size_t i, const float* upper, const float* lower) {
        const auto column = std::min(static_cast<std::size_t>(way[i].column), std::size_t{info.columns} - 2);
        const double u = way[i].column - static_cast<double>(column), v = way[i].row - rowOf(i);
        const double top = upper[column] + (upper[column + 1] - upper[column]) * u;
        const double bottom = lower[column] + (lower[column + 1] - lower[column]) * u;
        heights[i] = static_cast<float>(top + (bottom - top) * v);
    };
    Result<void> read =
        source.readHeights([&](std::uint32_t first, std::span<const float> rows) -> Result<void> {
            const auto count = static_cast<std::uint32_t>(rows.size() / info.columns);
            const auto rowAt = [&](std::uint32_t row) {
                return row < first ? last.data() : rows.data() + std::size_t{row - first} * info.columns;
            };
            while (next < order.size() && rowOf(order[next]) + 1 < first + count) {
                const std::uint32_t row = rowOf(order[next]);
                blend(order[next], rowAt(row), rowAt(row + 1));
                ++next;
            }
            last.assign(rows.end() - info.columns, rows.end());
            return {};
        });
    if (!read) return passOn(read);
    WalkHint walk;
    for (std::size_t i = 0; i < way.size(); ++i) {
        if (!std::isfinite(heights[i])) return std::optional<WalkHint>();
        const double east = way[i].column * info.cellMetres.x, south = way[i].row * info.cellMetres.y;
        const double up = heights[i];
        walk.points.push_back(info.firstSample + (info.up == UpAxis::y ? glm::dvec3(east, up, south)
                                                                       : glm::dvec3(east, -south, up)));
    }
    return std::optional<WalkHint>(std::move(walk));
}

}  // namespace fb
