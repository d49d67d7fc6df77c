#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/edge_uses.h"
#include "build/bake_charts.h"
#include "build/triangle_texels.h"

namespace fb {
namespace {

// A chart's triangles lean at most this much against its first one (60 degrees): none is seen edge-on or from
// behind.
constexpr double kLeastCosine = 0.5;

// Which triangles share an edge: pairs of triangle and neighbour, sorted.
std::vector<std::pair<std::uint32_t, std::uint32_t>> findNeighbours(std::span<const NodeTriangle> triangles) {
    std::vector<EdgeUse> uses;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles[i].baked) continue;
        for (std::uint32_t k = 0; k < 3; ++k) uses.push_back(edgeUse(triangles[i].positions, i, k));
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    visitEdges(uses, [&](std::span<const EdgeUse> of) {
        for (std::size_t i = 1; i < of.size(); ++i) {
            pairs.emplace_back(of[i].triangle, of[i - 1].triangle);
            pairs.emplace_back(of[i - 1].triangle, of[i].triangle);
        }
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

class ChartGrower {
  public:
    ChartGrower(std::span<NodeTriangle> triangles, const BlockMesh& mesh, double texelsPerGridUnit)
        : triangles_(triangles),
          mesh_(mesh),
          density_(texelsPerGridUnit),
          neighbours_(findNeighbours(triangles)) {}

    Chart grow(std::uint32_t seed, std::uint32_t chartNumber) {
        taken_.clear();
        const glm::dvec3 normal = normalOf(mesh_, triangles_[seed].positions);
        // Any two directions across it; along a ground or wall axis where there is one, which packs best.
        const glm::dvec3 helper = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 right = glm::normalize(glm::cross(helper, normal));
        axes_[0] = right * density_;
        axes_[1] = glm::cross(normal, right) * density_;
        origin_ = glm::dvec3(mesh_.positions[triangles_[seed].positions.x]);

        Chart chart;
        chart.baked = true;
        glm::vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
        std::vector<std::uint32_t> queue{seed};
        for (std::size_t at = 0; at < queue.size(); ++at) {
            NodeTriangle& t = triangles_[queue[at]];
            if (t.chart != kNone) continue;
            if (at > 0 && glm::dot(normalOf(mesh_, t.positions), normal) < kLeastCosine) continue;
            const Corners2 corners = project(t);
            if (!claim(corners) && at > 0) continue;
            t.chart = chartNumber;
            t.texels = corners;
            for (const glm::vec2& corner : corners) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
            chart.triangles.push_back(queue[at]);
            auto next = std::lower_bound(neighbours_.begin(), neighbours_.end(), std::pair(queue[at], 0u));
            for (; next != neighbours_.end() && next->first == queue[at]; ++next)
                queue.push_back(next->second);
        }
        low = glm::floor(low);
        for (const std::uint32_t i : chart.triangles) {
            for (glm::vec2& corner : triangles_[i].texels) corner -= low;
        }
        const glm::vec2 size = glm::max(glm::ceil(high - low), glm::vec2(1.0f));
        chart.width = static_cast<int>(size.x);
        chart.height = static_cast<int>(size.y);
        return chart;
    }

  private:
    [[nodiscard]] Corners2 project(const NodeTriangle& t) const {
        Corners2 corners;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 d = glm::dvec3(mesh_.positions[t.positions[k]]) - origin_;
            corners[static_cast<std::size_t>(k)] = glm::vec2(glm::dot(d, axes_[0]), glm::dot(d, axes_[1]));
        }
        return corners;
    }

    // Takes the texels inside the triangle; false, and takes none, where one is taken already.
    bool claim(const Corners2& corners) {
        claimed_.clear();
        bool free = true;
        visitTexels(corners, 0.0f, [&](int x, int y, float inside) {
            if (inside < 0.25f) return;
            const std::uint64_t key =
                std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
            free = free && !taken_.contains(key);
            claimed_.push_back(key);
        });
        if (free) taken_.insert(claimed_.begin(), claimed_.end());
        return free;
    }

    std::span<NodeTriangle> triangles_;
    const BlockMesh& mesh_;
    double density_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
    std::array<glm::dvec3, 2> axes_;
    glm::dvec3 origin_{0.0};
    std::unordered_set<std::uint64_t> taken_;  // texels, by column and row
    std::vector<std::uint64_t> claimed_;
};

}  // namespace

void addBakedCharts(std::span<NodeTriangle> triangles, const BlockMesh& mesh, double texelsPerGridUnit,
                    ChartSet& set) {
    for (NodeTriangle& t : triangles) {
        if (t.baked) t.chart = kNone;
    }
    ChartGrower grower(triangles, mesh, texelsPerGridUnit);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles[i].baked || triangles[i].chart != kNone) continue;
        set.charts.push_back(grower.grow(i, static_cast<std::uint32_t>(set.charts.size())));
    }
}

}  // namespace fb
