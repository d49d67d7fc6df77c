#include "build/terrain_grid.h"

#include <algorithm>

#include "build/quantise_block.h"  // gridFor

namespace fb {
namespace {

std::vector<std::int32_t> placesOf(std::uint32_t count, double unitsPerCell) {
    std::vector<std::int32_t> places(count);
    for (std::uint32_t i = 0; i < count; ++i)
        places[i] = static_cast<std::int32_t>(std::floor(i * unitsPerCell + 0.5));
    return places;
}

}  // namespace

Result<TerrainGrid> makeTerrainGrid(const TerrainInfo& info) {
    const glm::dvec2 span = glm::dvec2(info.columns - 1, info.rows - 1) * info.cellMetres;
    const double south = info.up == UpAxis::y ? 1.0 : -1.0;
    const auto place = [&](double east, double down, double height) {
        return info.firstSample + (info.up == UpAxis::y ? glm::dvec3(east, height, down * south)
                                                        : glm::dvec3(east, down * south, height));
    };
    Box3d bounds;
    const double low = info.lowestMetres, high = info.highestMetres;
    // A little more than the map: room for what skirts hang below the lowest height, and for rounding.
    const double room = std::max({span.x, span.y, high - low}) * 0x1p-20;
    for (const double s : {-room, room}) {
        bounds.grow(place(s < 0 ? s : span.x + s, s < 0 ? s : span.y + s, s < 0 ? low + s : high + s));
    }
    TerrainGrid grid;
    grid.grid = gridFor(bounds);
    grid.up = info.up;
    grid.columns = info.columns;
    grid.rows = info.rows;
    const double step = grid.grid.step;
    if (2.0 * step > std::min(info.cellMetres.x, info.cellMetres.y)) {
        return failure(info.name, {}, "its cells are too narrow for its size or the range of its heights",
                       "a terrain has 2^24 steps along its longest side; make cells wider or heights lower");
    }
    grid.across = placesOf(info.columns, info.cellMetres.x / step);
    grid.down = placesOf(info.rows, info.cellMetres.y / step);
    const glm::dvec3 first = (info.firstSample - grid.grid.origin) / step;
    const bool yUp = info.up == UpAxis::y;
    grid.firstAcross = static_cast<std::int32_t>(std::floor(first.x + 0.5));
    grid.firstDown = static_cast<std::int32_t>(std::floor((yUp ? first.z : first.y) + 0.5));
    grid.zeroHeight = yUp ? first.y : first.z;
    return grid;
}

}  // namespace fb
