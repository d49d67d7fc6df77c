#include "build/make_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "build/find_islands.h"

namespace fb {
namespace {

TexelRect unite(const TexelRect& a, const TexelRect& b) {
    const double x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// Joins rectangles of one texture as long as that saves room. Candidates are the neighbours along a
// space-filling curve: comparing all pairs would take quadratic time, and what lies close enough to be joined
// is close on the curve.
void joinRects(std::vector<TexelRect>& rects, const std::vector<Island>& islands, double scale,
               Joiner& joiner) {
    constexpr std::size_t kWindow = 12;
    constexpr int kRounds = 8;
    const auto curve = [&](std::uint32_t i) {
        const auto x = static_cast<std::uint64_t>(std::clamp(rects[i].x + rects[i].width / 2, 0.0, 4e9));
        const auto y = static_cast<std::uint64_t>(std::clamp(rects[i].y + rects[i].height / 2, 0.0, 4e9));
        std::uint64_t code = 0;
        for (int bit = 31; bit >= 0; --bit) code = code << 2 | (y >> bit & 1) << 1 | (x >> bit & 1);
        return code;
    };
    std::vector<std::uint32_t> alive(rects.size());
    std::iota(alive.begin(), alive.end(), 0u);
    for (int round = 0; round < kRounds; ++round) {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
        for (const std::uint32_t i : alive) order.emplace_back(curve(i), i);
        std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
            const std::uint32_t s = islands[a.second].surface, t = islands[b.second].surface;
            return s != t ? s < t : a < b;
        });
        bool joined = false;
        for (std::size_t a = 0; a < order.size(); ++a) {
            for (std::size_t b = a + 1; b < std::min(order.size(), a + kWindow); ++b) {
                const std::uint32_t i = joiner.find(order[a].second), j = joiner.find(order[b].second);
                if (i == j || islands[i].surface != islands[j].surface) continue;
                const TexelRect both = unite(rects[i], rects[j]);
                if (atlasTexels(both, scale) > atlasTexels(rects[i], scale) + atlasTexels(rects[j], scale))
                    continue;
                rects[joiner.join(i, j)] = both;
                joined = true;
            }
        }
        if (!joined) return;
        std::erase_if(alive, [&](std::uint32_t i) { return joiner.find(i) != i; });
    }
}

int scaledSide(double texels, double sharpTexels, double scale) {
    return std::max(1, static_cast<int>(std::lround(std::min(texels, sharpTexels) * scale)));
}

}  // namespace

ChartSet makeCharts(std::span<NodeTriangle> triangles, const BlockMesh& mesh, const BlockTextures& textures,
                    double scale) {
    const std::vector<Island> islands = findIslands(triangles, mesh, textures, scale);
    std::vector<TexelRect> rects;
    for (const Island& island : islands) rects.push_back(rectOf(island.low, island.high));
    Joiner joiner(islands.size());
    joinRects(rects, islands, scale, joiner);

    ChartSet set;
    std::vector<std::uint32_t> chartOf(islands.size(), kNone);
    for (std::uint32_t i = 0; i < islands.size(); ++i) {
        if (joiner.find(i) != i) continue;
        const glm::dvec2 size = textureSize(mesh.surfaces[islands[i].surface], textures);
        Chart chart;
        chart.surface = islands[i].surface;
        chart.rect = rects[i];
        const bool repeats =
            chart.rect.x + chart.rect.width > size.x || chart.rect.y + chart.rect.height > size.y;
        chart.edge = repeats ? EdgeMode::repeat : EdgeMode::extend;
        const glm::dvec2 sharp = kSharpRepeats * size;
        const bool blurred = chart.rect.width > sharp.x || chart.rect.height > sharp.y;
        if (blurred) ++set.blurredRepeats;
        chart.aligned = scale == 1.0 && !blurred && std::min(chart.rect.width, chart.rect.height) >= kLeastAlignedSide;
        if (chart.aligned) chart.rect = alignedToBlocks(chart.rect);
        chart.width = chart.aligned ? static_cast<int>(chart.rect.width) : scaledSide(chart.rect.width, sharp.x, scale);
        chart.height = chart.aligned ? static_cast<int>(chart.rect.height) : scaledSide(chart.rect.height, sharp.y, scale);
        chartOf[i] = static_cast<std::uint32_t>(set.charts.size());
        set.charts.push_back(std::move(chart));
    }
    for (NodeTriangle& t : triangles) {
        if (t.surface == 0) continue;
        const Island& island = islands[t.chart];
        t.chart = chartOf[joiner.find(t.chart)];
        const Chart& chart = set.charts[t.chart];
        const glm::dvec2 size = textureSize(mesh.surfaces[t.surface], textures);
        const glm::dvec2 corner = island.shift + glm::dvec2(chart.rect.x, chart.rect.y);
        const glm::dvec2 ratio(chart.width / chart.rect.width, chart.height / chart.rect.height);
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 at = (glm::dvec2(mesh.wedges[t.wedges[k]].uv) * size - corner) * ratio;
            t.texels[static_cast<std::size_t>(k)] =
                glm::vec2(glm::clamp(at, glm::dvec2(0.0), glm::dvec2(chart.width, chart.height)));
        }
    }
    return set;
}

}  // namespace fb
