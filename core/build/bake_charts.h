// Texels made anew for triangles that no single chart of the original covers: neighbours of like direction
// are projected onto a plane together, and each texel takes the colour of the closest point of the original.
// Comes from node_triangles (baked ones), adds to the charts of make_charts; fill_atlas calls bakeChart.
#pragma once

#include "build/make_charts.h"

namespace fb {

// Adds the charts of the baked triangles and sets their chart and texels (relative to the chart).
// `texelsPerGridUnit` as the node is to have them.
void addBakedCharts(std::span<NodeTriangle> triangles, const BlockMesh& mesh, double texelsPerGridUnit,
                    ChartSet& set);

// Fills the chart's place in the atlas; texels that no triangle comes near stay as they are. `known` (one per
// atlas texel) is set where something was written.
struct BakeTarget {
    Image& atlas;
    std::vector<std::uint8_t>& known;
};
void bakeChart(const Chart& chart, std::span<const NodeTriangle> triangles, const BlockMesh& mesh,
               const PieceSurface& surface, double texelsPerGridUnit, const BakeTarget& into);

}  // namespace fb
