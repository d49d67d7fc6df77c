// Finds the parts of the textures that a node shows, and how large each is to be in the node's atlas.
// Comes from node_triangles; pack_atlas places the charts, fill_atlas fills them.
// A chart is a rectangle of whole texels of one texture: the box of a connected set of triangles, joined with
// others where one rectangle takes less room than two with their gutters.
#pragma once

#include <span>
#include <vector>

#include "build/node_triangles.h"

namespace fb {

// Texels around each chart that repeat what lies beside it, so that filtering and coarse mip levels do not
// mix charts.
inline constexpr int kGutter = 2;

// Charts that keep the source's texels begin and end on whole blocks of this many texels, in the texture and in the atlas:
// their first mip levels are then those of the texture. Smaller ones would grow too much.
inline constexpr int kMipBlock = 8, kLeastAlignedSide = 32;

// A texture that repeats inside a chart is stored at full sharpness up to this many repeats per axis; beyond,
// the chart is stored smaller.
inline constexpr double kSharpRepeats = 8.0;

struct Chart {
    bool baked = false;
    bool aligned = false;       // to blocks of kMipBlock texels
    std::uint32_t surface = 0;  // of a chart that is not baked
    TexelRect rect;             // of its texture, whole texels
    EdgeMode edge = EdgeMode::extend;
    std::vector<std::uint32_t> triangles;  // of a baked chart
    int width = 0, height = 0;             // atlas texels
    int x = 0, y = 0;                      // place in the atlas, by packAtlas
};

struct ChartSet {
    std::vector<Chart> charts;
    std::uint64_t blurredRepeats = 0;  // charts with more than kSharpRepeats
};

// `scale`: atlas texels per source texel along each axis. Sets chart and texels (relative to the chart) of
// the textured triangles that are not baked; those are left to addBakedCharts.
[[nodiscard]] ChartSet makeCharts(std::span<NodeTriangle> triangles, const BlockMesh& mesh,
                                  const BlockTextures& textures, double scale);

}  // namespace fb
