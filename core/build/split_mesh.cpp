#include "build/split_mesh.h"

#include <algorithm>
#include <array>

namespace fb {
namespace {

// A position edge that was cut: from the position of lower number to that of higher number.
struct EdgeCut {
    std::uint32_t low, high, middle;
    double at;  // in (0, 1), from low to high
};

struct WedgeCut {
    std::uint32_t low, high, middle;  // by position numbers as in EdgeCut
};

struct Corner {
    std::uint32_t wedge, normal;
};

Corner cornerAtIndex(const MeshTriangle& triangle, int k) {
    return {triangle.wedges[k], triangle.normals[k]};
}
MeshTriangle triangleOf(const Corner& a, const Corner& b, const Corner& c) {
    return {{a.wedge, b.wedge, c.wedge}, {a.normal, b.normal, c.normal}};
}

std::uint64_t pairHash(std::uint32_t a, std::uint32_t b) {
    return mixBits(std::uint64_t{a} << 32 | b);
}

class Splitter {
  public:
    Splitter(BlockMesh& mesh, SplitCounters& counters) : mesh_(mesh), counters_(counters) {}

    // Appends the pieces of `piece`, number `parent` of `level`, to `next`.
    void splitPiece(const Level& level, std::uint32_t parent, int levelFactor, Level& next) {
        const Piece& piece = level.pieces[parent];
        const std::span<const MeshTriangle> part(level.triangles.data() + piece.begin, piece.size());
        std::vector<MeshTriangle> rest;
        rest.reserve(part.size());
        for (const MeshTriangle& triangle : part)
            refine(triangle, rest);  // by cuts of pieces beside this one
        glm::ivec3 low(kGridSize), high(-1);
        for (const MeshTriangle& triangle : rest) {
            for (int k = 0; k < 3; ++k) {
                low = glm::min(low, mesh_.at(triangle.wedges[k]));
                high = glm::max(high, mesh_.at(triangle.wedges[k]));
            }
        }
        const glm::ivec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        int pieces = 0;
        std::vector<MeshTriangle> upper;
        std::vector<CutPlane> cuts = piece.cuts;  // of the next slab
        const auto close = [&](std::size_t begin) {
            if (next.triangles.size() == begin) return;
            next.pieces.push_back({parent, static_cast<std::uint32_t>(begin),
                                   static_cast<std::uint32_t>(next.triangles.size()), cuts});
            ++pieces;
        };
        for (const std::int32_t plane : cuttingPlanes(low[axis], high[axis], levelFactor)) {
            const std::size_t begin = next.triangles.size();
            upper.clear();
            for (const MeshTriangle& triangle : rest) cut(triangle, axis, plane, next.triangles, upper);
            cuts.push_back({axis, plane});
            close(begin);
            cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(piece.cuts.size()), cuts.end() - 1);
            rest.swap(upper);
        }
        const std::size_t begin = next.triangles.size();
        next.triangles.insert(next.triangles.end(), rest.begin(), rest.end());
        close(begin);
        if (pieces == 0) {  // nothing but slivers that vanish in cutting: stay whole
            next.triangles.insert(next.triangles.end(), part.begin(), part.end());
            close(begin);
        }
        counters_.emptyPieces += static_cast<std::uint64_t>(levelFactor - pieces);
    }

    // Cuts the triangles of every piece at the new vertices that pieces beside it put on shared edges.
    Level refineAll(const Level& level) {
        Level result;
        result.triangles.reserve(level.triangles.size());
        for (const Piece& piece : level.pieces) {
            const auto begin = static_cast<std::uint32_t>(result.triangles.size());
            const std::span<const MeshTriangle> part(level.triangles.data() + piece.begin, piece.size());
            for (const MeshTriangle& triangle : part) refine(triangle, result.triangles);
            if (result.triangles.size() == begin) {  // as in splitPiece
                result.triangles.insert(result.triangles.end(), part.begin(), part.end());
            }
            result.pieces.push_back(
                {piece.parent, begin, static_cast<std::uint32_t>(result.triangles.size()), piece.cuts});
        }
        return result;
    }

  private:
    [[nodiscard]] std::uint32_t positionOf(const Corner& c) const { return mesh_.wedges[c.wedge].position; }

    void keep(const MeshTriangle& triangle, std::vector<MeshTriangle>& into) {
        if (isDegenerate(mesh_, triangle.wedges)) {
            ++counters_.degenerateTriangles;
        } else {
            into.push_back(triangle);
        }
    }

    [[nodiscard]] std::uint32_t findCut(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t low = std::min(a, b), high = std::max(a, b);
        return edgeIndex_.find(pairHash(low, high), [&](std::uint32_t i) {
            return edges_[i].low == low && edges_[i].high == high;
        });
    }

    // The cut of the edge by the plane; computed from the lower-numbered end, so that all its triangles
    // agree.
    std::uint32_t findOrMakeCut(std::uint32_t a, std::uint32_t b, int axis, std::int32_t plane) {
        if (const std::uint32_t found = findCut(a, b); found != kNone) return found;
        const std::uint32_t low = std::min(a, b), high = std::max(a, b);
        const GridPoint p = mesh_.positions[low], q = mesh_.positions[high];
        const double t = static_cast<double>(plane - p[axis]) / static_cast<double>(q[axis] - p[axis]);
        GridPoint middle(glm::round(glm::dvec3(p) + t * glm::dvec3(q - p)));
        middle[axis] = plane;
        const std::uint32_t position = mesh_.findOrAddPosition(middle);
        mesh_.onCut[position] = 1;
        edgeIndex_.insert(pairHash(low, high), static_cast<std::uint32_t>(edges_.size()));
        edges_.push_back({low, high, position, t});
        return static_cast<std::uint32_t>(edges_.size() - 1);
    }

    Corner cornerAt(const EdgeCut& cut, const Corner& a, const Corner& b) {
        const bool aIsLow = positionOf(a) == cut.low;
        const Corner& low = aIsLow ? a : b;
        const Corner& high = aIsLow ? b : a;
        return {wedgeAt(cut, low.wedge, high.wedge), normalAt(cut.at, low.normal, high.normal)};
    }

    std::uint32_t wedgeAt(const EdgeCut& cut, std::uint32_t low, std::uint32_t high) {
        const std::uint32_t found = wedgeIndex_.find(pairHash(low, high), [&](std::uint32_t i) {
            return wedgeCuts_[i].low == low && wedgeCuts_[i].high == high;
        });
        if (found != kNone) return wedgeCuts_[found].middle;
        const Wedge p = mesh_.wedges[low], q = mesh_.wedges[high];
        Wedge middle{cut.middle, p.surface, {}, {}};
        middle.uv = glm::vec2(glm::dvec2(p.uv) + cut.at * (glm::dvec2(q.uv) - glm::dvec2(p.uv)));
        const glm::dvec4 colour =
            glm::dvec4(p.colour) + cut.at * (glm::dvec4(q.colour) - glm::dvec4(p.colour));
        middle.colour = glm::u8vec4(glm::round(colour));
        const auto added = static_cast<std::uint32_t>(mesh_.wedges.size());
        mesh_.wedges.push_back(middle);
        wedgeIndex_.insert(pairHash(low, high), static_cast<std::uint32_t>(wedgeCuts_.size()));
        wedgeCuts_.push_back({low, high, added});
        return added;
    }

    std::uint32_t normalAt(double at, std::uint32_t low, std::uint32_t high) {
        if (low == high || high == kNone) return low;
        if (low == kNone) return high;
        const glm::vec3 mixed = glm::mix(mesh_.normals[low], mesh_.normals[high], static_cast<float>(at));
        const float length = glm::length(mixed);
        if (!(length > 1e-3f)) return at < 0.5 ? low : high;
        mesh_.normals.push_back(mixed / length);
        return static_cast<std::uint32_t>(mesh_.normals.size() - 1);
    }

    // Sorts a triangle below (or in) the plane or above it, in up to three parts.
    void cut(const MeshTriangle& triangle, int axis, std::int32_t plane, std::vector<MeshTriangle>& below,
             std::vector<MeshTriangle>& above) {
        std::array<std::int32_t, 3> side{};
        int under = 0, over = 0;
        for (int k = 0; k < 3; ++k) {
            side[static_cast<std::size_t>(k)] = mesh_.at(triangle.wedges[k])[axis] - plane;
            const std::int32_t s = side[static_cast<std::size_t>(k)];
            if (s == 0) mesh_.onCut[mesh_.wedges[triangle.wedges[k]].position] = 1;
            under += s < 0 ? 1 : 0;
            over += s > 0 ? 1 : 0;
        }
        if (over == 0) return below.push_back(triangle);
        if (under == 0) return above.push_back(triangle);

        // Turn the triangle so that corner `a` is the one alone on its side, or the one in the plane.
        int first = 0;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t s = side[static_cast<std::size_t>(k)];
            const bool onPlane = under == 1 && over == 1;
            if (onPlane ? s == 0 : (under == 1 ? s < 0 : s > 0)) first = k;
        }
        const Corner a = cornerAtIndex(triangle, first), b = cornerAtIndex(triangle, (first + 1) % 3),
                     c = cornerAtIndex(triangle, (first + 2) % 3);
        const auto edge = [&](const Corner& p, const Corner& q) {
            const EdgeCut made = edges_[findOrMakeCut(positionOf(p), positionOf(q), axis, plane)];
            return cornerAt(made, p, q);
        };
        if (under == 1 && over == 1) {  // a in the plane, b and c on either side
            const Corner m = edge(b, c);
            const bool bBelow = mesh_.at(b.wedge)[axis] < plane;
            keep(triangleOf(a, b, m), bBelow ? below : above);
            keep(triangleOf(a, m, c), bBelow ? above : below);
            return;
        }
        const Corner m = edge(a, b), n = edge(c, a);
        std::vector<MeshTriangle>& ofA = under == 1 ? below : above;
        std::vector<MeshTriangle>& ofOthers = under == 1 ? above : below;
        keep(triangleOf(a, m, n), ofA);
        // The quad m b c n along its shorter diagonal.
        const auto squared = [&](const Corner& p, const Corner& q) {
            const glm::dvec3 d = glm::dvec3(mesh_.at(p.wedge) - mesh_.at(q.wedge));
            return glm::dot(d, d);
        };
        if (squared(m, c) <= squared(b, n)) {
            keep(triangleOf(m, b, c), ofOthers);
            keep(triangleOf(m, c, n), ofOthers);
        } else {
            keep(triangleOf(m, b, n), ofOthers);
            keep(triangleOf(b, c, n), ofOthers);
        }
    }

    // The triangle, split at every cut that its edges have by now; only edges with both ends on cuts can have
    // one.
    void refine(const MeshTriangle& triangle, std::vector<MeshTriangle>& into) {
        if (!edgeIndex_.empty()) {
            for (int k = 0; k < 3; ++k) {
                const Corner a = cornerAtIndex(triangle, k), b = cornerAtIndex(triangle, (k + 1) % 3);
                const std::uint32_t p = positionOf(a), q = positionOf(b);
                if (mesh_.onCut[p] == 0 || mesh_.onCut[q] == 0) continue;
                const std::uint32_t found = findCut(p, q);
                if (found == kNone) continue;
                const Corner c = cornerAtIndex(triangle, (k + 2) % 3);
                const Corner m = cornerAt(edges_[found], a, b);
                refine(triangleOf(a, m, c), into);
                refine(triangleOf(m, b, c), into);
                return;
            }
        }
        keep(triangle, into);
    }

    BlockMesh& mesh_;
    SplitCounters& counters_;
    std::vector<EdgeCut> edges_;
    HashIndex edgeIndex_;
    std::vector<WedgeCut> wedgeCuts_;
    HashIndex wedgeIndex_;
};

}  // namespace

std::vector<std::int32_t> cuttingPlanes(std::int32_t low, std::int32_t high, int levelFactor) {
    std::vector<std::int32_t> planes;
    for (int k = 1; k < levelFactor; ++k) {
        const std::int64_t scaled = static_cast<std::int64_t>(high - low) * k;
        const auto plane = low + static_cast<std::int32_t>((2 * scaled + levelFactor) / (2 * levelFactor));
        if (plane > low && plane < high && (planes.empty() || plane > planes.back())) planes.push_back(plane);
    }
    return planes;
}

Level splitLevel(BlockMesh& mesh, const Level& level, int levelFactor, SplitCounters& counters) {
    Splitter splitter(mesh, counters);
    Level next;
    next.triangles.reserve(level.triangles.size() + level.triangles.size() / 8);
    for (std::uint32_t i = 0; i < level.pieces.size(); ++i) splitter.splitPiece(level, i, levelFactor, next);
    return splitter.refineAll(next);
}

}  // namespace fb
