#include "build/stand_ins.h"

#include <algorithm>
#include <cmath>

#include "base/triangle_tree.h"
#include "build/join_neighbours.h"

namespace fb {
namespace {

// Fewer small parts, or less of the piece's area, are clutter: simplified like anything else, but for what lies so far
// from the rest (in sides of the triangles that the piece should have) that it would be missed, which gets this much of
// the aim at most.
constexpr std::size_t kLeastParts = 16;
constexpr double kLeastAreaShare = 0.1, kFarSides = 0.5, kFarShare = 1.0 / 16.0;
constexpr std::size_t kMostTriangles = 4;  // of a stand-in: a tetrahedron
constexpr int kHalvings = 30;

// A few triangles over their own corners.
struct Shape {
    std::vector<glm::dvec3> corners;
    std::vector<glm::uvec3> triangles;
};

double areaOf(const Shape& shape, const glm::dvec3& scale) {
    double area = 0.0;
    for (const glm::uvec3& t : shape.triangles) {
        const glm::dvec3 a = shape.corners[t.x] * scale;
        area += 0.5 * glm::length(glm::cross(shape.corners[t.y] * scale - a, shape.corners[t.z] * scale - a));
    }
    return area;
}

// The part as it is where it has few triangles; else the tetrahedron of corners far apart, facing outward;
// where all lie in a plane, two triangles.
class ShapeOfPart {
  public:
    ShapeOfPart(const BlockMesh& mesh, std::span<const glm::uvec3> triangles, const Part& part) {
        for (const std::uint32_t i : part.triangles)
            for (int k = 0; k < 3; ++k) points_.push_back(glm::dvec3(mesh.positions[triangles[i][k]]));
        if (part.triangles.size() <= kMostTriangles) {
            shape_.corners = points_;
            for (std::uint32_t i = 0; i < points_.size(); i += 3)
                shape_.triangles.emplace_back(i, i + 1, i + 2);
            return;
        }
        spanPoints(part.centre);
    }
    [[nodiscard]] Shape take() { return std::move(shape_); }

  private:
    template <class Measure>
    [[nodiscard]] glm::dvec3 farthest(Measure&& measure) const {
        const auto less = [&](const glm::dvec3& a, const glm::dvec3& b) { return measure(a) < measure(b); };
        return *std::max_element(points_.begin(), points_.end(), less);
    }

    void spanPoints(const glm::dvec3& centre) {
        const glm::dvec3 a = farthest([&](const glm::dvec3& p) { return glm::distance(p, centre); });
        const glm::dvec3 b = farthest([&](const glm::dvec3& p) { return glm::distance(p, a); });
        const glm::dvec3 c =
            farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(b - a, p - a)); });
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const glm::dvec3 d = farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(normal, p - a)); });
        const double side = glm::dot(normal, d - a);
        if (std::abs(side) > 1e-3 * std::pow(glm::length(normal), 1.5)) {
            shape_.corners = {a, b, c, d};
            shape_.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
            if (side > 0.0)
                for (glm::uvec3& t : shape_.triangles) std::swap(t.y, t.z);
            return;
        }
        // Flat: the corner farthest to the other side of a-b than c.
        const glm::dvec3 across = glm::cross(normal, b - a);
        const glm::dvec3 e = farthest([&](const glm::dvec3& p) { return -glm::dot(across, p - a); });
        shape_.corners = {a, b, c, e};
        shape_.triangles = {{0, 1, 2}, {1, 0, 3}};
    }

    std::vector<glm::dvec3> points_;
    Shape shape_;
};

class StandInMaker {
  public:
    StandInMaker(BlockMesh& mesh, std::span<const glm::uvec3> triangles, std::size_t aim)
        : mesh_(mesh), triangles_(triangles), aim_(aim) {}

    StandIns make(Numbering& numbering) {
        const std::vector<Part> parts = findParts(mesh_, triangles_, numbering);
        double area = 0.0, smallArea = 0.0;
        for (const Part& part : parts) area += part.area;
        std::vector<const Part*> small, large;
        for (const Part& part : parts) {
            const bool isSmall = static_cast<double>(aim_) * part.area < static_cast<double>(kMostTriangles) * area;
            (isSmall ? small : large).push_back(&part);
            smallArea += isSmall ? part.area : 0.0;
        }
        const auto aim = static_cast<double>(aim_);
        result_.replaced.assign(triangles_.size(), 0);
        if (small.size() >= kLeastParts && smallArea >= kLeastAreaShare * area) {
            std::ranges::stable_sort(small, {}, [](const Part* part) { return part->curve; });
            const auto budget = static_cast<std::size_t>(aim * smallArea / area);
            for (const Run& run : affordableRuns(small, budget)) standFor(run);
        } else {
            // What has many small triangles keeps enough of them by itself.
            const double left = aim / static_cast<double>(triangles_.size());
            std::erase_if(small, [&](const Part* part) {
                const double kept = left * static_cast<double>(part->triangles.size());
                return part->triangles.size() > kMostTriangles && kept >= static_cast<double>(kMostTriangles);
            });
            const double side = std::sqrt(2.0 * area / aim);
            const auto budget = static_cast<std::size_t>(aim * kFarShare);
            for (const Part* part : farthestParts(small, large, kFarSides * side, budget)) standFor({&part, 1});
        }
        if (result_.triangles.empty()) return {};
        return std::move(result_);
    }

  private:
    using Run = std::span<const Part* const>;

    [[nodiscard]] TriangleTree treeOf(const std::vector<const Part*>& parts) const {
        std::vector<TriangleCorners> corners;
        for (const Part* part : parts) {
            for (const std::uint32_t i : part->triangles) {
                const glm::uvec3& t = triangles_[i];
                corners.push_back({glm::vec3(mesh_.positions[t.x]), glm::vec3(mesh_.positions[t.y]),
                                   glm::vec3(mesh_.positions[t.z])});
            }
        }
        return TriangleTree(std::move(corners));
    }

    // Of the small parts, one after the other, that which reaches farthest from the large ones and from those taken
    // already: as long as that is farther than `distance` and there are triangles for it (Gonzalez 1985, Clustering to
    // minimize the maximum intercluster distance).
    [[nodiscard]] std::vector<const Part*> farthestParts(const std::vector<const Part*>& small,
                                                         const std::vector<const Part*>& large, double distance,
                                                         std::size_t triangles) const {
        std::vector<const Part*> taken;
        if (large.empty() || small.empty() || triangles == 0) return taken;
        const TriangleTree tree = treeOf(large);
        std::vector<double> away;
        for (const Part* part : small) {
            float squared = 0.0f;
            for (const std::uint32_t i : part->triangles) {
                for (int k = 0; k < 3; ++k)
                    squared = std::max(squared, tree.closest(glm::vec3(mesh_.positions[triangles_[i][k]])).squaredDistance);
            }
            away.push_back(std::sqrt(static_cast<double>(squared)));
        }
        for (;;) {
            const auto farthest = static_cast<std::size_t>(std::ranges::max_element(away) - away.begin());
            const Part* const part = small[farthest];
            const std::size_t needed = std::min(part->triangles.size(), kMostTriangles);
            if (away[farthest] <= distance || needed > triangles) return taken;
            triangles -= needed;
            taken.push_back(part);
            for (std::size_t i = 0; i < small.size(); ++i) {
                const double between = glm::distance(small[i]->centre, part->centre) + 0.5 * small[i]->bounds.diagonal();
                away[i] = std::min(away[i], i == farthest ? 0.0 : between);
            }
        }
    }

    static const Part* largestOf(const Run& run) {
        return *std::ranges::max_element(run, {}, [](const Part* part) { return part->area; });
    }

    // As many as there are triangles for. How many each needs shows only when it is known what is joined.
    static std::vector<Run> affordableRuns(const std::vector<const Part*>& parts, std::size_t triangles) {
        for (std::size_t count = std::clamp<std::size_t>(triangles, 1, parts.size());;) {
            std::vector<Run> runs;
            std::size_t begin = 0, needed = 0;
            for (const std::size_t end : joinNeighbours(parts, count)) {
                runs.push_back(Run(parts).subspan(begin, end - begin));
                needed += std::min(largestOf(runs.back())->triangles.size(), kMostTriangles);
                begin = end;
            }
            if (needed <= triangles || count == 1) return runs;
            count = std::max<std::size_t>(1, std::min(count - 1, count * triangles / needed));
        }
    }

    void standFor(const Run& run) {
        double area = 0.0;
        for (const Part* part : run) area += part->area;
        Box3d bounds;
        glm::dvec3 centre(0.0), size(0.0);
        for (const Part* part : run) {
            bounds.grow(part->bounds.min);
            bounds.grow(part->bounds.max);
            centre += part->area / area * part->centre;
            size += part->area / area * part->bounds.size();
            for (const std::uint32_t i : part->triangles) result_.replaced[i] = 1;
        }
        place(ShapeOfPart(mesh_, triangles_, *largestOf(run)).take(), size, bounds, centre, area);
    }

    // As large as the parts on average, and larger until it has their area or fills their bounds.
    void place(const Shape& shape, const glm::dvec3& size, const Box3d& bounds, const glm::dvec3& centre,
               double area) {
        Box3d own;
        for (const glm::dvec3& p : shape.corners) own.grow(p);
        const auto scaleFor = [&](double growth) {
            glm::dvec3 scale(0.0);
            for (int k = 0; k < 3; ++k) {
                const double wanted = std::min(size[k] * growth, bounds.size()[k]);
                scale[k] = own.size()[k] > 0.0 ? wanted / own.size()[k] : 1.0;
            }
            return scale;
        };
        double low = 0.0, high = 1.0;
        while (areaOf(shape, scaleFor(high)) < area && high < 1e6) high *= 2.0;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (areaOf(shape, scaleFor(middle)) < area ? low : high) = middle;
        }
        const glm::dvec3 scale = scaleFor(high), half = 0.5 * scale * own.size();
        const glm::dvec3 at =
            glm::clamp(centre, bounds.min + half, glm::max(bounds.min + half, bounds.max - half));
        const glm::dvec3 middle = 0.5 * (own.min + own.max);
        std::vector<std::uint32_t> ids;
        for (const glm::dvec3& p : shape.corners) {
            const glm::dvec3 moved = glm::round(at + scale * (p - middle));
            ids.push_back(mesh_.findOrAddPosition(
                GridPoint(glm::clamp(moved, glm::dvec3(0.0), glm::dvec3(kGridSize - 1)))));
        }
        for (const glm::uvec3& t : shape.triangles) {
            const glm::uvec3 made(ids[t.x], ids[t.y], ids[t.z]);
            if (!isDegenerate(mesh_.positions[made.x], mesh_.positions[made.y], mesh_.positions[made.z]))
                result_.triangles.push_back(made);
        }
    }

    BlockMesh& mesh_;
    std::span<const glm::uvec3> triangles_;
    std::size_t aim_;
    StandIns result_;
};

}  // namespace

StandIns makeStandIns(BlockMesh& mesh, std::span<const glm::uvec3> triangles, std::size_t aim,
                      Numbering& numbering) {
    if (triangles.size() <= aim) return {};
    return StandInMaker(mesh, triangles, aim).make(numbering);
}

}  // namespace fb
