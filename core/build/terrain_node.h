// A tile's surface with skirts and texture: what is stored, and the record that the hierarchy keeps.
// Comes from terrain_tile, terrain_border and terrain_drape; goes to build_terrain.
// A skirt hangs straight down from a border where tiles of other levels can lie beside it, to one step below
// the lowest that they or this border lie there; it takes normals and texture from the edge it hangs from.
#pragma once

#include "build/terrain_drape.h"
#include "build/terrain_tile.h"
#include "scenefile/scene.h"
#include "settings/settings.h"

namespace fb {

struct TerrainLook {
    const TerrainInfo& info;
    const TerrainDrape& drape;
    const BuildSettings& settings;
    std::uint32_t leafDrapeLevel =
        0;  // of the picture's pyramid; above 0 where its texels are too many for a node
};

// The first level of the picture at which a whole leaf's texels fit build.max_texture_side.
[[nodiscard]] std::uint32_t leafDrapeLevel(const TerrainInfo& info, const TerrainLayout& layout,
                                           const BuildSettings& settings);

struct TerrainNode {
    BuiltNode record;  // without links and payload
    NodeData data;
};
[[nodiscard]] Result<TerrainNode> makeTerrainNode(const TerrainBuild& build, const TerrainLook& look,
                                                  const TerrainTile& tile);

}  // namespace fb
