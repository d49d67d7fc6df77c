#include "build/pack_atlas.h"

#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "scenefile/node_data.h"

namespace fb {
namespace {

// The room that a chart takes with its gutters. Beside charts that are aligned, all take whole blocks: the packer then
// places them at multiples of a block.
struct Cells {
    int block = 1;
    explicit Cells(std::span<const Chart> charts) {
        for (const Chart& chart : charts) block = chart.aligned ? kMipBlock : block;
    }
    // In an atlas with this side, beyond whose edges gutters may hang.
    [[nodiscard]] int side(int texels, int atlas) const {
        return std::min((texels + 2 * kGutter + block - 1) / block * block, atlas + 2 * kGutter);
    }
};

// Every size of the classes that could hold the charts, smallest area first, then the squarest.
std::vector<AtlasSize> candidates(std::span<const Chart> charts, int maxSide) {
    int width = 1, height = 1;
    std::int64_t texels = 0;
    for (const Chart& chart : charts) {
        width = std::max(width, chart.width);
        height = std::max(height, chart.height);
        texels += std::int64_t{chart.width + 2 * kGutter} * (chart.height + 2 * kGutter);
    }
    const auto classes = [&](int least) {
        std::vector<int> sides;
        for (auto side = atlasSide(static_cast<std::uint32_t>(least));
             side <= static_cast<std::uint32_t>(maxSide); side = atlasSide(side + 1)) {
            sides.push_back(static_cast<int>(side));
        }
        return sides;
    };
    std::vector<AtlasSize> sizes;
    for (const int w : classes(width)) {
        for (const int h : classes(height)) {
            if (std::int64_t{w + 2 * kGutter} * (h + 2 * kGutter) >= texels) sizes.push_back({w, h});
        }
    }
    const auto rank = [](const AtlasSize& s) {
        return std::tuple(std::int64_t{s.width} * s.height, std::max(s.width, s.height), s.width);
    };
    std::sort(sizes.begin(), sizes.end(),
              [&](const AtlasSize& a, const AtlasSize& b) { return rank(a) < rank(b); });
    return sizes;
}

// The packer goes by rows from the tallest chart to the lowest; on its side it goes by columns. Each way fits some sets
// of charts that the others do not.
struct PackingWay {
    int heuristic;
    bool onItsSide;
};
constexpr PackingWay kPackingWays[] = {{STBRP_HEURISTIC_Skyline_BL_sortHeight, false},
                                       {STBRP_HEURISTIC_Skyline_BF_sortHeight, false},
                                       {STBRP_HEURISTIC_Skyline_BL_sortHeight, true},
                                       {STBRP_HEURISTIC_Skyline_BF_sortHeight, true}};

bool packInto(std::span<Chart> charts, const AtlasSize& size, const PackingWay& way,
              std::vector<stbrp_rect>& rects, std::vector<stbrp_node>& nodes) {
    // Gutters may hang over the atlas's edge, hence the larger target; a cell's corner there is its chart's corner in
    // the atlas.
    const Cells cells(charts);
    int width = size.width + 2 * kGutter, height = size.height + 2 * kGutter;
    if (way.onItsSide) std::swap(width, height);
    rects.clear();
    for (std::size_t i = 0; i < charts.size(); ++i) {
        stbrp_rect rect{};
        rect.id = static_cast<int>(i);
        rect.w = cells.side(charts[i].width, size.width);
        rect.h = cells.side(charts[i].height, size.height);
        if (way.onItsSide) std::swap(rect.w, rect.h);
        rects.push_back(rect);
    }
    nodes.resize(static_cast<std::size_t>(width));
    stbrp_context context;
    stbrp_init_target(&context, width, height, nodes.data(), width);
    stbrp_setup_heuristic(&context, way.heuristic);
    if (stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size())) == 0) return false;
    // Which of several charts of one size gets which place depends on the C library's sort; order them
    // ourselves.
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> places;
    for (stbrp_rect& rect : rects) {
        if (!way.onItsSide) continue;
        std::swap(rect.w, rect.h);
        std::swap(rect.x, rect.y);
    }
    for (const stbrp_rect& rect : rects) places[{rect.w, rect.h}].emplace_back(-rect.y, -rect.x);
    for (auto& [sides, free] : places) std::sort(free.begin(), free.end());
    for (Chart& chart : charts) {
        auto& free = places[{cells.side(chart.width, size.width), cells.side(chart.height, size.height)}];
        chart.x = -free.back().second;
        chart.y = -free.back().first;
        free.pop_back();
    }
    return true;
}

}  // namespace

bool packAtlas(std::span<Chart> charts, int maxSide, AtlasSize& size) {
    std::vector<stbrp_rect> rects;
    std::vector<stbrp_node> nodes;
    for (const AtlasSize& candidate : candidates(charts, maxSide)) {
        for (const PackingWay& way : kPackingWays) {
            if (!packInto(charts, candidate, way, rects, nodes)) continue;
            size = candidate;
            return true;
        }
    }
    return false;
}

}  // namespace fb
