#include "build/skirts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_set>

#include "build/border_edges.h"
#include "build/farthest_from.h"

namespace fb {
namespace {

// Gaps up to this are rounding (farthest_from.h).
constexpr double kClosed = kFarthestUnits + 1.0;
// Depths are bounds with little to spare: a bit more covers corners, where the strip does not hang at right angles.
constexpr int kProbes = 6;  // along an edge, besides its first end
constexpr double kSpare = 1.25;
// The other block's border may lie as far off as this one's, to the other side.
constexpr double kBlockFactor = 2.0;
// Of an edge's length, to close what rounding leaves open (rasterisers place vertices to 1/256 of a pixel).
constexpr double kSeal = 1.0 / 64.0;
// A spike's tip is farther from the straight line below it than that is from the spike.
constexpr double kStrayFactor = 2.0;
// The surface runs along the cutting plane rather than through it.
constexpr double kGrazing = 0.1;

struct LineKey {
    BorderKind kind = BorderKind::cut;
    CutPlane plane;

    auto operator<=>(const LineKey&) const = default;
};

struct PieceBorder {
    std::vector<glm::uvec3> drawn;
    std::vector<BorderEdge> edges;
    std::map<std::uint32_t, glm::dvec3> normals;  // by border position: of all triangles there, by area
};

// What one level's border vertex needs.
struct Hem {
    glm::dvec3 down{0.0};  // sum over its edges
    double depth = 0.0;
};

glm::dvec3 pointOf(const BlockMesh& mesh, std::uint32_t position) {
    return glm::dvec3(mesh.positions[position]);
}

class SkirtPlanner {
  public:
    SkirtPlanner(BlockMesh& mesh, const std::vector<BlockLevel>& levels,
                 const std::vector<std::vector<double>>& errors)
        : mesh_(mesh), levels_(levels), errors_(errors), lines_(levels.size()), edges_(levels.size()) {}

    std::vector<std::vector<Skirts>> plan() {
        std::vector<std::vector<PieceBorder>> borders(levels_.size());
        for (std::size_t l = 0; l < levels_.size(); ++l) {
            for (std::size_t i = 0; i < levels_[l].original.pieces.size(); ++i) borders[l].push_back(borderOf(l, i));
            collectLines(l, borders[l]);
        }
        std::vector<std::vector<Skirts>> skirts(levels_.size());
        for (std::size_t l = 0; l < levels_.size(); ++l) {
            for (std::size_t i = 0; i < borders[l].size(); ++i) skirts[l].push_back(skirtsOf(borders[l][i], l, i));
        }
        return skirts;
    }

  private:
    PieceBorder borderOf(std::size_t l, std::size_t i) const {
        const BlockLevel& level = levels_[l];
        PieceBorder border{level.drawn(mesh_, i), {}, {}};
        const bool clustered = !level.isLeaves() && level.simplified[i].clustered;
        border.edges = findBorderEdges(mesh_, level.original.pieces[i], border.drawn, clustered);
        for (const BorderEdge& edge : border.edges) {
            const auto [a, b] = ends(border, edge);
            border.normals.try_emplace(a, 0.0);
            border.normals.try_emplace(b, 0.0);
        }
        for (const glm::uvec3& t : border.drawn) {
            const glm::dvec3 cross = crossOf(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
            for (int k = 0; k < 3; ++k) {
                if (const auto at = border.normals.find(t[k]); at != border.normals.end()) at->second += cross;
            }
        }
        return border;
    }

    void collectLines(std::size_t l, const std::vector<PieceBorder>& borders) {
        std::map<LineKey, std::vector<TriangleCorners>> segments;
        for (const PieceBorder& border : borders) {
            for (const BorderEdge& edge : border.edges) {
                const auto [a, b] = ends(border, edge);
                const glm::vec3 p(mesh_.positions[a]), q(mesh_.positions[b]);
                segments[{edge.kind, edge.plane}].push_back({p, q, q});
                edges_[l].insert(keyOf(a, b));
            }
        }
        for (auto& [key, line] : segments) lines_[l].emplace(key, TriangleTree(std::move(line)));
    }

    static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    static std::pair<std::uint32_t, std::uint32_t> ends(const PieceBorder& border, const BorderEdge& edge) {
        const glm::uvec3& t = border.drawn[edge.triangle];
        return {t[edge.corner], t[(edge.corner + 1) % 3]};
    }

    // Unit: from one end of the edge to where the skirt hangs.
    glm::dvec3 downFrom(const PieceBorder& border, const BorderEdge& edge, std::uint32_t end) const {
        const glm::uvec3& t = border.drawn[edge.triangle];
        const glm::dvec3 face = normalOf(mesh_, t);
        const auto [a, b] = ends(border, edge);
        const glm::dvec3 outward = glm::cross(glm::normalize(pointOf(mesh_, b) - pointOf(mesh_, a)), face);
        if (edge.kind != BorderKind::cut) return glm::normalize(outward - face);
        // Of all triangles at the vertex: one that lies in the cutting plane itself does not know which way is down.
        const glm::dvec3& normal = border.normals.at(end);
        glm::dvec3 down = -normal;
        down[edge.plane.axis] = 0.0;
        if (glm::length(down) < kGrazing * glm::length(normal) || glm::length(normal) == 0.0) {
            down = outward;
            down[edge.plane.axis] = 0.0;
        }
        return glm::length(down) > 0.0 ? glm::normalize(down) : -face;
    }

    struct Gap {
        double width = 0.0;
        std::uint32_t across = 0;  // the other line's segment where it is widest
        bool isBelow = false;
    };

    // The widest gap between a segment and a line, and whether the line lies below somewhere.
    static Gap gapTo(const TriangleTree& line, const TriangleCorners& segment, const glm::dvec3& down) {
        Gap gap;
        ClosestPoint near;
        for (int i = 0; i <= kProbes; ++i) {
            const glm::vec3 probe = glm::mix(segment[0], segment[1], static_cast<float>(i) / kProbes);
            if (near.triangle != ~std::uint32_t{0}) near = line.closestOn(near.triangle, probe);
            near = line.closest(probe, near, -1.0f, [](std::uint32_t) { return true; });
            const double width = std::sqrt(static_cast<double>(near.squaredDistance));
            if (i == 0 || width > gap.width) gap.width = width, gap.across = near.triangle;
            const TriangleCorners& c = line.triangles()[near.triangle];
            const glm::vec3 on = c[0] * near.weights.x + c[1] * near.weights.y + c[2] * near.weights.z;
            gap.isBelow = gap.isBelow || glm::dot(glm::dvec3(on - probe), down) > 1.0;
        }
        return gap;
    }

    // How far a segment of one level's border strays from another level's.
    double strayOf(std::size_t of, std::size_t from, const LineKey& key, std::uint32_t segment) {
        const TriangleTree& segments = lines_[of].at(key);
        std::vector<float>& strays = strays_[{of, from, key}];
        strays.resize(segments.triangles().size(), -1.0f);
        float& stray = strays[segment];
        if (stray < 0.0f) {
            const Gap gap = gapTo(lines_[from].at(key), segments.triangles()[segment], glm::dvec3(0.0));
            stray = static_cast<float>(gap.width);
        }
        return static_cast<double>(stray);
    }

    std::size_t ancestorAt(std::size_t level, std::size_t piece, std::size_t wanted) const {
        for (; level > wanted; --level) piece = levels_[level].original.pieces[piece].parent;
        return piece;
    }

    // Whether the edge belongs to a small part that has a stand-in at that level: no surface goes on beyond.
    bool isReplaced(std::size_t level, std::size_t piece, std::uint32_t a, std::uint32_t b) const {
        const std::vector<std::uint32_t>& replaced = levels_[level].simplified[piece].replaced;
        return std::ranges::binary_search(replaced, a) || std::ranges::binary_search(replaced, b);
    }

    double depthOf(const PieceBorder& border, const BorderEdge& edge, std::size_t l, std::size_t i,
                   const glm::dvec3& down) {
        if (edge.kind == BorderKind::free) return errors_[l][i];
        const auto [a, b] = ends(border, edge);
        const TriangleCorners segment = {glm::vec3(mesh_.positions[a]), glm::vec3(mesh_.positions[b]),
                                         glm::vec3(mesh_.positions[b])};
        const LineKey key{edge.kind, edge.plane};
        const double factor = edge.kind == BorderKind::block ? kBlockFactor : 1.0;
        double depth = 0.0;
        for (std::size_t m = 0; m < levels_.size(); ++m) {
            const auto line = lines_[m].find(key);
            if (m == l || line == lines_[m].end()) continue;
            if (m < l && isReplaced(m, ancestorAt(l, i, m), a, b)) continue;
            const Gap gap = gapTo(line->second, segment, down);
            if (gap.width <= kClosed || !gap.isBelow) continue;
            // Where the other level has nothing any more, its border is far off and close to another part of this one;
            // and what joins two ends of a border is none where the border does not go along. No gap is to be closed.
            const double width = std::min(factor * gap.width, kStrayFactor * strayOf(m, l, key, gap.across));
            const std::size_t coarse = std::min(l, m);
            depth = std::max(depth, std::min(width, 2.0 * errors_[coarse][ancestorAt(l, i, coarse)]));
        }
        return depth;
    }

    // Where a finer level has vertices along an edge, rounding on the screen leaves pinholes.
    double sealOf(const PieceBorder& border, const BorderEdge& edge, std::size_t l) const {
        if (edge.kind == BorderKind::free) return 0.0;
        const auto [a, b] = ends(border, edge);
        const std::uint64_t key = keyOf(a, b);
        for (std::size_t m = l + 1; m < levels_.size(); ++m) {
            if (!edges_[m].contains(key)) return kSeal * glm::distance(pointOf(mesh_, a), pointOf(mesh_, b));
        }
        return 0.0;
    }

    Skirts skirtsOf(const PieceBorder& border, std::size_t l, std::size_t i) {
        std::map<std::pair<LineKey, std::uint32_t>, Hem> hems;  // by line and position
        Skirts skirts;
        for (const BorderEdge& edge : border.edges) {
            const auto [a, b] = ends(border, edge);
            const std::array<glm::dvec3, 2> downs = {downFrom(border, edge, a), downFrom(border, edge, b)};
            const double gap = depthOf(border, edge, l, i, downs[0] + downs[1]);
            const double depth = std::max(gap, sealOf(border, edge, l));
            skirts.gapGridUnits = std::max(skirts.gapGridUnits, gap);
            for (std::size_t k = 0; k < 2; ++k) {
                Hem& hem = hems[{{edge.kind, edge.plane}, k == 0 ? a : b}];
                hem.down += downs[k];
                hem.depth = std::max(hem.depth, depth);
            }
        }
        for (const BorderEdge& edge : border.edges) {
            const auto [a, b] = ends(border, edge);
            const LineKey key{edge.kind, edge.plane};
            const std::uint32_t belowA = below(a, hems[{key, a}]), belowB = below(b, hems[{key, b}]);
            if (belowA == a && belowB == b) continue;
            skirts.edges.push_back({edge.triangle, edge.corner, belowA, belowB});
        }
        return skirts;
    }

    std::uint32_t below(std::uint32_t position, const Hem& hem) {
        const double length = glm::length(hem.down);
        if (hem.depth <= 0.0 || length < 1e-3) return position;
        const glm::dvec3 at = pointOf(mesh_, position) + hem.down * (hem.depth * kSpare / length);
        return mesh_.findOrAddPosition(
            GridPoint(glm::clamp(glm::round(at), glm::dvec3(0.0), glm::dvec3(kGridSize - 1))));
    }

    BlockMesh& mesh_;
    const std::vector<BlockLevel>& levels_;
    const std::vector<std::vector<double>>& errors_;
    std::vector<std::map<LineKey, TriangleTree>> lines_;  // by level
    std::vector<std::unordered_set<std::uint64_t>> edges_;  // by level, of all lines: ends
    // By level, other level and line: how far each segment strays, or -1.
    std::map<std::tuple<std::size_t, std::size_t, LineKey>, std::vector<float>> strays_;
};

// The same triangle with its corners taken from these ones of `from`, at these positions.
void append(std::vector<NodeTriangle>& triangles, const BlockMesh& mesh, const NodeTriangle& from,
            const std::array<int, 3>& corners, const glm::uvec3& positions) {
    if (isDegenerate(mesh.positions[positions.x], mesh.positions[positions.y], mesh.positions[positions.z])) return;
    NodeTriangle made = from;
    made.skirt = true;
    made.positions = positions;
    for (int k = 0; k < 3; ++k) {
        const auto to = static_cast<std::size_t>(k), at = static_cast<std::size_t>(corners[to]);
        made.wedges[k] = from.wedges[corners[to]];
        made.normals[to] = from.normals[at];
        made.colours[to] = from.colours[at];
        made.texels[to] = from.texels[at];
    }
    triangles.push_back(made);
}

}  // namespace

std::vector<std::vector<Skirts>> planSkirts(BlockMesh& mesh, const std::vector<BlockLevel>& levels,
                                            const std::vector<std::vector<double>>& errors) {
    return SkirtPlanner(mesh, levels, errors).plan();
}

void addSkirts(std::vector<NodeTriangle>& triangles, const BlockMesh& mesh, const Skirts& skirts) {
    for (const SkirtEdge& edge : skirts.edges) {
        const NodeTriangle from = triangles[edge.triangle];
        const int first = edge.corner, second = (edge.corner + 1) % 3;
        const std::uint32_t a = from.positions[first], b = from.positions[second];
        // Facing outward, away from the triangle.
        append(triangles, mesh, from, {second, first, first}, {b, a, edge.belowFirst});
        append(triangles, mesh, from, {second, first, second}, {b, edge.belowFirst, edge.belowSecond});
    }
}

}  // namespace fb
