// The geometric error of a terrain tile: a true upper bound of how far the map lies from what is drawn.
// Where a triangle of the tile lies over the map, distances are vertical, and the difference of the two
// surfaces, both linear piece by piece, is largest at a vertex of their overlay: a sample of the map, or a
// place where an edge of the tile crosses a grid line or a diagonal of the map. All of these are looked at,
// at full resolution, window by window. Where simplification cut off a part of the map beside a hole,
// distances are to the nearest point of the tile, plus the width of the cells concerned. What a tile draws
// over a hole does not count.
#pragma once

#include "build/terrain_tile.h"

namespace fb {

// In grid units. Windows are measured in parallel.
[[nodiscard]] Result<double> terrainError(const TerrainHeights& heights, const TerrainGrid& grid,
                                          const TileMesh& tile);

}  // namespace fb
