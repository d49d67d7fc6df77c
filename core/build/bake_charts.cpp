#include "build/bake_charts.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace fb {
namespace {

// A chart's triangles lean at most this much against its first one (60 degrees): none is seen edge-on or from
// behind.
constexpr double kLeastCosine = 0.5;
// Texels this far outside a triangle are baked with it, so that filtering at its edge finds them.
constexpr float kMargin = 1.5f;
// Texels a side whose closest points are searched together.
constexpr int kBakeBlock = 4;

using Corners2 = std::array<glm::vec2, 3>;

glm::dvec3 normalOf(const BlockMesh& mesh, const NodeTriangle& t) {
    return glm::normalize(
        crossOf(mesh.positions[t.positions.x], mesh.positions[t.positions.y], mesh.positions[t.positions.z]));
}

// How deep inside a triangle a point lies, in texels (negative outside: distance to the worst edge's line).
float insideness(const Corners2& t, const glm::vec2& p) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 a = t[k], along = t[(k + 1) % 3] - a;
        const float length = glm::length(along);
        if (length > 0.0f) least = std::min(least, (along.x * (p.y - a.y) - along.y * (p.x - a.x)) / length);
    }
    return least;
}

// Calls visit(x, y, inside) for the texels whose centres lie in the triangle or up to `margin` outside.
template <class Visit>
void visitTexels(const Corners2& t, float margin, Visit&& visit) {
    const float low = std::min(t[0].y, std::min(t[1].y, t[2].y)),
                high = std::max(t[0].y, std::max(t[1].y, t[2].y));
    for (int y = static_cast<int>(std::floor(low - margin)); y < static_cast<int>(std::ceil(high + margin));
         ++y) {
        const float centre = static_cast<float>(y) + 0.5f;
        const float top = centre - margin, bottom = centre + margin;
        float left = std::numeric_limits<float>::max(), right = std::numeric_limits<float>::lowest();
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 a = t[k], b = t[(k + 1) % 3];
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
            const float rise = b.y - a.y;
            const float t0 = rise == 0.0f ? 0.0f : glm::clamp((top - a.y) / rise, 0.0f, 1.0f);
            const float t1 = rise == 0.0f ? 1.0f : glm::clamp((bottom - a.y) / rise, 0.0f, 1.0f);
            for (const float at : {t0, t1}) {
                left = std::min(left, a.x + at * (b.x - a.x));
                right = std::max(right, a.x + at * (b.x - a.x));
            }
        }
        if (left > right) continue;
        for (int x = static_cast<int>(std::floor(left - margin));
             x < static_cast<int>(std::ceil(right + margin)); ++x) {
            const float inside = insideness(t, {static_cast<float>(x) + 0.5f, centre});
            if (inside >= -margin) visit(x, y, inside);
        }
    }
}

// Which triangles share an edge: pairs of triangle and neighbour, sorted.
std::vector<std::pair<std::uint32_t, std::uint32_t>> findNeighbours(std::span<const NodeTriangle> triangles) {
    struct Edge {
        std::uint32_t low, high, triangle;
        auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles[i].baked) continue;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles[i].positions[k], b = triangles[i].positions[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), i});
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high) continue;
        pairs.emplace_back(edges[i].triangle, edges[i - 1].triangle);
        pairs.emplace_back(edges[i - 1].triangle, edges[i].triangle);
    }
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
        const glm::dvec3 normal = normalOf(mesh_, triangles_[seed]);
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
            if (at > 0 && glm::dot(normalOf(mesh_, t), normal) < kLeastCosine) continue;
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

struct BakedTexel {
    std::uint32_t owner;  // triangle
    glm::ivec2 at;        // in the chart
};

// Bakes texels that lie close together, so that those of one triangle need one search of the original.
class BlockBaker {
  public:
    BlockBaker(std::span<const NodeTriangle> triangles, const BlockMesh& mesh, const PieceSurface& surface,
               double texelsPerGridUnit)
        : triangles_(triangles), mesh_(mesh), surface_(surface) {
        // A texel is the mean of several points of the original: averaging in the texture instead, by its coarser
        // levels, would mix in what lies beside a chart there. One point for two texels of the original, no more
        // than nine.
        const double texelsAcross = surface.texelsPerGridUnit() / texelsPerGridUnit;
        across_ = std::clamp(static_cast<int>(std::ceil(0.5 * texelsAcross)), 1, 3);
        side_ = 1.0 / (texelsPerGridUnit * across_);
    }

    void bake(std::vector<BakedTexel>& texels, const Chart& chart, const BakeTarget& into) {
        std::stable_sort(texels.begin(), texels.end(),
                         [](const BakedTexel& a, const BakedTexel& b) { return a.owner < b.owner; });
        for (std::size_t begin = 0, end = 0; begin < texels.size(); begin = end) {
            while (end < texels.size() && texels[end].owner == texels[begin].owner) ++end;
            bakeOwned({texels.data() + begin, end - begin}, chart, into);
        }
    }

  private:
    void bakeOwned(std::span<const BakedTexel> texels, const Chart& chart, const BakeTarget& into) {
        const NodeTriangle& t = triangles_[texels[0].owner];
        findPoints(texels, t);
        Box3f box;
        for (const glm::vec3& point : points_) box.grow(point);
        const glm::vec3 centre = 0.5f * (box.min + box.max);
        float reach2 = 0.0f;
        for (const glm::vec3& point : points_) reach2 = std::max(reach2, glm::dot(point - centre, point - centre));
        surface_.findCandidates(centre, std::sqrt(reach2), glm::vec3(normalOf(mesh_, t)), near_, candidates_);
        const auto channels = static_cast<std::size_t>(into.atlas.channels);
        const auto count = static_cast<unsigned>(across_ * across_);
        auto point = points_.begin();
        for (const BakedTexel& texel : texels) {
            glm::uvec4 sum(0u);
            for (unsigned i = 0; i < count; ++i) {
                const PieceSurface::Hit hit = surface_.closestOf(candidates_, *point++);
                near_ = hit.triangle;
                sum += glm::uvec4(surface_.colourAt(hit, side_));
            }
            const std::size_t at = static_cast<std::size_t>(chart.y + texel.at.y) * into.atlas.width +
                                   static_cast<std::size_t>(chart.x + texel.at.x);
            into.known[at] = 1;
            for (std::size_t c = 0; c < channels; ++c) {
                into.atlas.pixels[at * channels + c] =
                    static_cast<std::uint8_t>((sum[static_cast<int>(c)] + count / 2) / count);
            }
        }
    }

    // On the triangle, across_ * across_ for each texel.
    void findPoints(std::span<const BakedTexel> texels, const NodeTriangle& t) {
        const TriangleCorners flat = {glm::vec3(t.texels[0], 0), glm::vec3(t.texels[1], 0),
                                      glm::vec3(t.texels[2], 0)};
        points_.clear();
        for (const BakedTexel& texel : texels) {
            for (int i = 0; i < across_ * across_; ++i) {
                const glm::vec2 in(static_cast<float>(i % across_) + 0.5f, static_cast<float>(i / across_) + 0.5f);
                const glm::vec2 at = glm::vec2(texel.at) + in / static_cast<float>(across_);
                const glm::vec3 weights = closestOnTriangle(glm::vec3(at, 0.0f), flat).weights;
                glm::vec3 point(0.0f);
                for (int k = 0; k < 3; ++k) point += glm::vec3(mesh_.positions[t.positions[k]]) * weights[k];
                points_.push_back(point);
            }
        }
    }

    std::span<const NodeTriangle> triangles_;
    const BlockMesh& mesh_;
    const PieceSurface& surface_;
    int across_ = 1;
    double side_ = 0.0;
    std::uint32_t near_ = kNone;
    std::vector<glm::vec3> points_;
    std::vector<std::uint32_t> candidates_;
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

void bakeChart(const Chart& chart, std::span<const NodeTriangle> triangles, const BlockMesh& mesh,
               const PieceSurface& surface, double texelsPerGridUnit, const BakeTarget& into) {
    struct Texel {
        float inside = -kMargin;
        std::uint32_t triangle = kNone;
    };
    std::vector<Texel> owners(static_cast<std::size_t>(chart.width) * chart.height);
    for (const std::uint32_t i : chart.triangles) {
        visitTexels(triangles[i].texels, kMargin, [&](int x, int y, float inside) {
            if (x < 0 || y < 0 || x >= chart.width || y >= chart.height) return;
            Texel& texel = owners[static_cast<std::size_t>(y) * chart.width + x];
            if (inside > texel.inside) texel = {inside, i};
        });
    }
    BlockBaker baker(triangles, mesh, surface, texelsPerGridUnit);
    std::vector<BakedTexel> block;
    for (int top = 0; top < chart.height; top += kBakeBlock) {
        for (int left = 0; left < chart.width; left += kBakeBlock) {
            block.clear();
            for (int y = top; y < std::min(top + kBakeBlock, chart.height); ++y) {
                for (int x = left; x < std::min(left + kBakeBlock, chart.width); ++x) {
                    const std::uint32_t owner = owners[static_cast<std::size_t>(y) * chart.width + x].triangle;
                    if (owner != kNone) block.push_back({owner, {x, y}});
                }
            }
            baker.bake(block, chart, into);
        }
    }
}

}  // namespace fb
