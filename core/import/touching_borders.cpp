#include "import/touching_borders.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "base/edge_uses.h"
#include "base/triangle_tree.h"

namespace fb {
namespace {

// A place where a block's surface ends.
struct BorderPoint {
    glm::dvec3 at{0.0};
    std::uint32_t block = 0;
    double tolerance = 0.0;  // metres
    bool isTouching = false;
    std::vector<std::uint32_t> vertices;  // of the block
};

// By vertex, a number that vertices at one position have in common.
std::vector<std::uint32_t> numberPositions(const std::vector<glm::dvec3>& positions) {
    const auto key = [&](std::uint32_t v) { return std::tuple(positions[v].x, positions[v].y, positions[v].z); };
    std::vector<std::uint32_t> order(positions.size()), numbers(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, key);
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1])) ++number;
        numbers[order[i]] = number;
    }
    return numbers;
}

class TouchFinder {
  public:
    explicit TouchFinder(std::span<SourceBlock> blocks) : blocks_(blocks) {}

    void run() {
        for (std::uint32_t b = 0; b < blocks_.size(); ++b) addBorder(b);
        if (points_.empty()) return;
        buildTree();
        for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
            for (const glm::uvec3& t : blocks_[b].mesh.triangles) touch(b, t);
        }
        for (const BorderPoint& point : points_) {
            if (!point.isTouching) continue;
            for (const std::uint32_t v : point.vertices) blocks_[point.block].mesh.shared[v] = 1;
        }
    }

  private:
    // Ends of edges that only one triangle has, but for those that another block has too.
    void addBorder(std::uint32_t b) {
        const SourceMesh& mesh = blocks_[b].mesh;
        const std::vector<std::uint32_t> numbers = numberPositions(mesh.positions);
        std::vector<EdgeUse> uses;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3& t = mesh.triangles[i];
            const glm::uvec3 points(numbers[t.x], numbers[t.y], numbers[t.z]);
            for (std::uint32_t k = 0; k < 3; ++k) uses.push_back(edgeUse(points, i, k));
        }
        std::vector<std::uint32_t> pointOf(mesh.positions.size(), kNoPoint);  // by number
        visitEdges(uses, [&](std::span<const EdgeUse> of) {
            if (of.size() == 1) pointOf[of[0].low] = pointOf[of[0].high] = kNew;
        });
        Box3d box;
        for (const glm::dvec3& p : mesh.positions) box.grow(p);
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            std::uint32_t& point = pointOf[numbers[v]];
            if (point == kNoPoint || mesh.shared[v] != 0) continue;
            if (point == kNew) {
                point = static_cast<std::uint32_t>(points_.size());
                points_.push_back({mesh.positions[v], b, kTouching * box.diagonal(), false, {}});
            }
            points_[point].vertices.push_back(v);
        }
    }

    void buildTree() {
        Box3d box;
        for (const BorderPoint& point : points_) {
            box.grow(point.at);
            reach_ = std::max(reach_, point.tolerance);
        }
        centre_ = box.centre();
        reach_ += 1e-6 * box.diagonal();  // rounding to float
        std::vector<TriangleCorners> corners;
        for (const BorderPoint& point : points_) {
            const glm::vec3 at(point.at - centre_);
            corners.push_back({at, at, at});
        }
        tree_.emplace(std::move(corners));
    }

    void touch(std::uint32_t b, const glm::uvec3& t) {
        const std::vector<glm::dvec3>& positions = blocks_[b].mesh.positions;
        const glm::dvec3 &p = positions[t.x], &q = positions[t.y], &r = positions[t.z], middle = (p + q + r) / 3.0;
        const double radius = std::max({glm::distance(p, middle), glm::distance(q, middle), glm::distance(r, middle)});
        const TriangleCorners corners = {glm::vec3(0.0f), glm::vec3(q - p), glm::vec3(r - p)};
        tree_->visitNear(
            glm::vec3(middle - centre_), static_cast<float>((radius + reach_) * (1.0 + 1e-5)),
            [&](std::uint32_t i) { return points_[i].block != b && !points_[i].isTouching; },
            [&](std::uint32_t i) {
                BorderPoint& point = points_[i];
                const float distance2 = closestOnTriangle(point.at - p, corners).squaredDistance;
                point.isTouching = static_cast<double>(distance2) <= point.tolerance * point.tolerance;
            });
    }

    static constexpr std::uint32_t kNoPoint = ~std::uint32_t{0}, kNew = kNoPoint - 1;

    std::span<SourceBlock> blocks_;
    std::vector<BorderPoint> points_;
    std::optional<TriangleTree> tree_;
    glm::dvec3 centre_{0.0};
    double reach_ = 0.0;
};

}  // namespace

void markTouchingBorders(std::span<SourceBlock> blocks) {
    TouchFinder(blocks).run();
}

}  // namespace fb
