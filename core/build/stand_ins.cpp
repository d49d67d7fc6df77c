#include "build/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

namespace fb {
namespace {

constexpr std::size_t kLeastParts = 16;    // fewer are simplified like anything else
constexpr double kLeastAreaShare = 0.1;    // of the piece: less is clutter that nobody misses from afar
constexpr std::size_t kMostTriangles = 4;  // of a stand-in: a tetrahedron
constexpr int kHalvings = 30;

struct Part {
    std::vector<std::uint32_t> triangles;
    double area = 0.0;
    glm::dvec3 centre{0.0};  // by area
    Box3d bounds;
    std::uint64_t curve = 0;  // place along the space-filling curve
};

std::uint64_t spreadBits(std::uint64_t v) {  // 21 bits to every third
    std::uint64_t spread = 0;
    for (int bit = 0; bit < 21; ++bit) spread |= (v >> bit & 1u) << (3 * bit);
    return spread;
}

std::uint64_t mortonCode(const glm::dvec3& p) {
    const glm::dvec3 cell = glm::clamp(p / 8.0, glm::dvec3(0.0), glm::dvec3(kGridSize / 8 - 1));
    return spreadBits(static_cast<std::uint64_t>(cell.x)) |
           spreadBits(static_cast<std::uint64_t>(cell.y)) << 1 |
           spreadBits(static_cast<std::uint64_t>(cell.z)) << 2;
}

class PartFinder {
  public:
    PartFinder(const BlockMesh& mesh, std::span<const glm::uvec3> triangles)
        : mesh_(mesh), triangles_(triangles) {
        ids_.reserve(triangles.size() * 3);
        for (const glm::uvec3& t : triangles) ids_.insert(ids_.end(), {t.x, t.y, t.z});
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        root_.resize(ids_.size());
        std::iota(root_.begin(), root_.end(), 0u);
    }

    // In the order of their first triangles.
    std::vector<Part> find() {
        std::vector<std::uint32_t> first(triangles_.size());
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const glm::uvec3& t = triangles_[i];
            first[i] = local(t.x);
            unite(first[i], local(t.y));
            unite(first[i], local(t.z));
        }
        std::vector<Part> parts;
        std::vector<std::uint32_t> partOf(ids_.size(), kNone);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            std::uint32_t& part = partOf[rootOf(first[i])];
            if (part == kNone) {
                part = static_cast<std::uint32_t>(parts.size());
                parts.emplace_back();
            }
            add(parts[part], i);
        }
        for (Part& part : parts) {
            part.centre /= part.area;
            part.curve = mortonCode(part.centre);
        }
        return parts;
    }

  private:
    void add(Part& part, std::uint32_t i) const {
        const glm::uvec3& t = triangles_[i];
        const std::array<glm::dvec3, 3> p = {mesh_.positions[t.x], mesh_.positions[t.y],
                                             mesh_.positions[t.z]};
        const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        part.triangles.push_back(i);
        part.area += area;
        part.centre += area / 3.0 * (p[0] + p[1] + p[2]);
        for (const glm::dvec3& corner : p) part.bounds.grow(corner);
    }
    [[nodiscard]] std::uint32_t local(std::uint32_t position) const {
        return static_cast<std::uint32_t>(std::lower_bound(ids_.begin(), ids_.end(), position) -
                                          ids_.begin());
    }
    std::uint32_t rootOf(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = rootOf(a), b = rootOf(b);
        root_[std::max(a, b)] = std::min(a, b);
    }

    const BlockMesh& mesh_;
    std::span<const glm::uvec3> triangles_;
    std::vector<std::uint32_t> ids_, root_;
};

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

// Parts along the curve, joined with those beside them until `count` runs are left: always the two neighbours
// whose common bounds are smallest.
class RunJoiner {
  public:
    explicit RunJoiner(const std::vector<const Part*>& parts) : runs_(parts.size()) {
        for (std::uint32_t i = 0; i < runs_.size(); ++i) {
            runs_[i] = {i, i + 1, i + 1, i == 0 ? kNone : i - 1, 0, parts[i]->bounds};
        }
        for (std::uint32_t i = 0; i + 1 < runs_.size(); ++i) propose(i);
    }

    // Ends of runs, in order.
    std::vector<std::size_t> join(std::size_t count) {
        for (std::size_t left = runs_.size(); left > count && !queue_.empty();) {
            const Proposal best = queue_.top();
            queue_.pop();
            Run& run = runs_[best.run];
            if (run.version != best.version || run.next >= runs_.size()) continue;
            if (runs_[run.next].version != best.nextVersion) continue;
            joinNext(best.run);
            --left;
        }
        std::vector<std::size_t> ends;
        for (std::uint32_t i = 0; i < runs_.size(); i = runs_[i].next) ends.push_back(runs_[i].end);
        return ends;
    }

  private:
    struct Run {
        std::uint32_t begin = 0, end = 0;  // of the parts
        std::uint32_t next = 0, before = kNone;
        std::uint32_t version = 0;
        Box3d bounds;
    };
    struct Proposal {
        double size;
        std::uint32_t run, version, nextVersion;
        bool operator<(const Proposal& other) const {  // the smallest first
            return std::tie(size, run) > std::tie(other.size, other.run);
        }
    };

    void propose(std::uint32_t i) {
        const Run &run = runs_[i], &next = runs_[run.next];
        Box3d both = run.bounds;
        both.grow(next.bounds.min);
        both.grow(next.bounds.max);
        queue_.push({glm::length(both.size()), i, run.version, next.version});
    }
    void joinNext(std::uint32_t i) {
        Run& run = runs_[i];
        Run& gone = runs_[run.next];
        run.bounds.grow(gone.bounds.min);
        run.bounds.grow(gone.bounds.max);
        run.end = gone.end;
        run.next = gone.next;
        ++run.version;
        ++gone.version;
        if (run.next < runs_.size()) {
            runs_[run.next].before = i;
            propose(i);
        }
        if (run.before != kNone) propose(run.before);
    }

    std::vector<Run> runs_;
    std::priority_queue<Proposal> queue_;
};

class StandInMaker {
  public:
    StandInMaker(BlockMesh& mesh, std::span<const glm::uvec3> triangles, std::size_t aim)
        : mesh_(mesh), triangles_(triangles), aim_(aim) {}

    StandIns make() {
        std::vector<Part> parts = PartFinder(mesh_, triangles_).find();
        double area = 0.0, smallArea = 0.0;
        for (const Part& part : parts) area += part.area;
        std::vector<const Part*> small;
        std::size_t needed = 0;
        for (const Part& part : parts) {
            if (static_cast<double>(aim_) * part.area >= static_cast<double>(kMostTriangles) * area) continue;
            small.push_back(&part);
            smallArea += part.area;
            needed += std::min(part.triangles.size(), kMostTriangles);
        }
        if (small.size() < kLeastParts || smallArea < kLeastAreaShare * area) return {};
        const double budget = static_cast<double>(aim_) * smallArea / area;
        const double each = static_cast<double>(needed) / static_cast<double>(small.size());
        const auto count = static_cast<std::size_t>(std::max(1.0, std::floor(budget / each)));
        std::ranges::stable_sort(small, {}, [](const Part* part) { return part->curve; });
        result_.replaced.assign(triangles_.size(), 0);
        for (const std::span<const Part* const> run : runsOf(small, count)) standFor(run);
        if (result_.triangles.empty()) return {};
        return std::move(result_);
    }

  private:
    static std::vector<std::span<const Part* const>> runsOf(const std::vector<const Part*>& parts,
                                                            std::size_t count) {
        std::vector<std::span<const Part* const>> runs;
        std::size_t begin = 0;
        for (const std::size_t end : RunJoiner(parts).join(count)) {
            runs.push_back(std::span(parts).subspan(begin, end - begin));
            begin = end;
        }
        return runs;
    }

    void standFor(std::span<const Part* const> run) {
        double area = 0.0;
        for (const Part* part : run) area += part->area;
        Box3d bounds;
        glm::dvec3 centre(0.0), size(0.0);
        const Part* largest = run[0];
        for (const Part* part : run) {
            bounds.grow(part->bounds.min);
            bounds.grow(part->bounds.max);
            centre += part->area / area * part->centre;
            size += part->area / area * part->bounds.size();
            if (part->area > largest->area) largest = part;
            for (const std::uint32_t i : part->triangles) result_.replaced[i] = 1;
        }
        place(ShapeOfPart(mesh_, triangles_, *largest).take(), size, bounds, centre, area);
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

StandIns makeStandIns(BlockMesh& mesh, std::span<const glm::uvec3> triangles, std::size_t aim) {
    if (triangles.size() <= aim) return {};
    return StandInMaker(mesh, triangles, aim).make();
}

}  // namespace fb
