// Hangs skirts from a tile's borders: see terrain_node.h for when and how deep. Comes from terrain_tile.
#pragma once

#include "build/terrain_tile.h"

namespace fb {

// Appends the skirts' vertices and triangles to the tile. Gives the widest gap to a neighbour of another
// level that there would be without them, in grid units.
[[nodiscard]] Result<double> hangSkirts(const TerrainBuild& build, TileMesh& tile);

}  // namespace fb
