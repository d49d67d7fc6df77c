#include "build/fit_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/edge_uses.h"
#include "base/triangle_tree.h"
#include "build/least_squares.h"

namespace fb {
namespace {

// Points of the original for each vertex that is drawn: more than these say the same again.
constexpr std::size_t kPointsEach = 8;
constexpr double kLeastDeviation = 0.5;  // grid units: root mean square below which nothing moves
// A point counts where it lies over the inside of a triangle rather than beside it, and for no more than an outlier:
// what was left out of the simplified surface must not pull on the rest.
constexpr double kBeside = 1.0, kOutlier = 3.0;
constexpr double kLeastTurnCosine = 0.5;
constexpr int kTurnRounds = 8;

struct Point {
    glm::dvec3 at{0.0}, normal{0.0};  // the normal's length: twice the area around
};

class SurfaceFit {
  public:
    SurfaceFit(BlockMesh& mesh, std::span<const MeshTriangle> original, std::span<const glm::uvec3> drawn,
               Numbering& numbering)
        : mesh_(mesh) {
        numbering.restart();
        for (const glm::uvec3& t : drawn) {
            glm::uvec3 local;
            for (int k = 0; k < 3; ++k) {
                const auto [number, isNew] = numbering.take(t[k]);
                local[k] = number;
                if (isNew) vertices_.push_back(t[k]);
            }
            triangles_.push_back(local);
        }
        findPoints(original, numbering);
        findFixed();
    }

    std::vector<MovedVertex> run() {
        std::vector<MovedVertex> moved;
        if (std::ranges::all_of(isFixed_, [](std::uint8_t fixed) { return fixed != 0; })) return moved;
        findNormals();
        LeastSquares problem = makeProblem();
        if (problem.rows.empty()) return moved;
        moves_ = problem.solve(vertices_.size());
        for (std::size_t v = 0; v < moves_.size(); ++v) {
            const double most = reach_[v];
            moves_[v] = isFixed_[v] != 0 ? 0.0 : std::clamp(moves_[v], -most, most);
        }
        keepTurnsSmall();
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
            const GridPoint to = movedPoint(v);
            if (to == mesh_.positions[vertices_[v]]) continue;
            moved.push_back({vertices_[v], mesh_.findOrAddPosition(to)});
        }
        std::ranges::sort(moved);
        return moved;
    }

  private:
    // Some of the original's vertices, and which of the drawn ones are among them.
    void findPoints(std::span<const MeshTriangle> original, Numbering& numbering) {
        isFixed_.assign(vertices_.size(), 1);
        const std::size_t drawn = vertices_.size();
        std::vector<Point> all(drawn);  // by number: the drawn ones first
        for (const MeshTriangle& t : original) {
            glm::uvec3 positions, numbers;
            for (int k = 0; k < 3; ++k) {
                positions[k] = mesh_.wedges[t.wedges[k]].position;
                const auto [number, isNew] = numbering.take(positions[k]);
                numbers[k] = number;
                if (isNew) all.emplace_back();
                if (numbers[k] < drawn) isFixed_[numbers[k]] = 0;
            }
            const glm::dvec3 cross = crossOf(mesh_.positions[positions.x], mesh_.positions[positions.y],
                                             mesh_.positions[positions.z]);
            for (int k = 0; k < 3; ++k) {
                Point& point = all[numbers[k]];
                point.at = glm::dvec3(mesh_.positions[positions[k]]);
                point.normal += cross;
            }
        }
        const std::size_t stride = std::max<std::size_t>(1, all.size() / (kPointsEach * drawn));
        for (std::size_t i = 0; i < all.size(); i += stride) points_.push_back(all[i]);
    }

    // Also where an edge has not two triangles.
    void findFixed() {
        std::vector<EdgeUse> uses;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) uses.push_back(edgeUse(triangles_[t], t, k));
        }
        visitEdges(uses, [&](std::span<const EdgeUse> of) {
            if (of.size() != 2) isFixed_[of[0].low] = isFixed_[of[0].high] = 1;
        });
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (mesh_.onCut[vertices_[v]] != 0 || mesh_.isOnBlockBorder(vertices_[v])) isFixed_[v] = 1;
        }
    }

    [[nodiscard]] glm::dvec3 crossAt(const glm::uvec3& t) const {
        return crossOf(mesh_.positions[vertices_[t.x]], mesh_.positions[vertices_[t.y]],
                       mesh_.positions[vertices_[t.z]]);
    }

    void findNormals() {
        normals_.assign(vertices_.size(), glm::dvec3(0.0));
        for (const glm::uvec3& t : triangles_) {
            for (int k = 0; k < 3; ++k) normals_[t[k]] += crossAt(t);
        }
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            const double length = glm::length(normals_[v]);
            if (length > 0.0) normals_[v] /= length;
            else isFixed_[v] = 1;
        }
    }

    // One row for each point: its distance to the plane of the closest triangle, and how much the moves of that
    // triangle's corners change it.
    LeastSquares makeProblem() {
        std::vector<TriangleCorners> corners;
        std::vector<glm::dvec3> faces;
        for (const glm::uvec3& t : triangles_) {
            corners.push_back({glm::vec3(mesh_.positions[vertices_[t.x]]), glm::vec3(mesh_.positions[vertices_[t.y]]),
                               glm::vec3(mesh_.positions[vertices_[t.z]])});
            faces.push_back(glm::normalize(crossAt(t)));
        }
        const TriangleTree tree(std::move(corners));
        LeastSquares problem;
        ClosestPoint near;
        double squares = 0.0, weights = 0.0;
        for (const Point& point : points_) {
            const double weight = glm::length(point.normal);
            if (weight == 0.0) continue;
            const auto facing = [&](std::uint32_t f) { return glm::dot(faces[f], point.normal) > 0.0; };
            const bool startsNear = near.triangle < triangles_.size() && facing(near.triangle);
            near = tree.closest(glm::vec3(point.at), startsNear ? tree.closestOn(near.triangle, point.at) : ClosestPoint{},
                                -1.0f, facing);
            if (near.triangle >= triangles_.size()) continue;
            const glm::dvec3& face = faces[near.triangle];
            const double distance = glm::dot(face, point.at - glm::dvec3(tree.triangles()[near.triangle][0]));
            const double beside2 = std::max(0.0, static_cast<double>(near.squaredDistance) - distance * distance);
            if (beside2 > distance * distance + kBeside) continue;
            LeastSquares::Row row{triangles_[near.triangle], {}, distance, weight};
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t v = row.unknowns[k];
                row.factors[k] = isFixed_[v] != 0 ? 0.0 : static_cast<double>(near.weights[k]) * glm::dot(face, normals_[v]);
            }
            squares += weight * distance * distance;
            weights += weight;
            problem.rows.push_back(row);
        }
        const double deviation = weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
        if (deviation < kLeastDeviation) problem.rows.clear();
        reach_.assign(vertices_.size(), 0.0);
        for (LeastSquares::Row& row : problem.rows) {
            row.value = std::clamp(row.value, -kOutlier * deviation, kOutlier * deviation);
            for (int k = 0; k < 3; ++k) {
                double& reach = reach_[row.unknowns[k]];
                reach = std::max(reach, std::abs(row.value));
            }
        }
        return problem;
    }

    [[nodiscard]] GridPoint movedPoint(std::uint32_t v) const {
        const glm::dvec3 to = glm::dvec3(mesh_.positions[vertices_[v]]) + moves_[v] * normals_[v];
        return GridPoint(glm::clamp(glm::round(to), glm::dvec3(0.0), glm::dvec3(kGridSize - 1)));
    }

    // Halves, and in the end takes back, moves that turn a triangle too far.
    void keepTurnsSmall() {
        for (int round = 0; round <= kTurnRounds; ++round) {
            bool areSmall = true;
            for (const glm::uvec3& t : triangles_) {
                const glm::dvec3 before = crossAt(t), after = crossOf(movedPoint(t.x), movedPoint(t.y), movedPoint(t.z));
                const double most = glm::length(before) * glm::length(after);
                if (glm::dot(before, after) > kLeastTurnCosine * most) continue;
                areSmall = false;
                for (int k = 0; k < 3; ++k) moves_[t[k]] *= round + 1 < kTurnRounds ? 0.5 : 0.0;
            }
            if (areSmall) return;
        }
        std::ranges::fill(moves_, 0.0);
    }

    BlockMesh& mesh_;
    std::vector<std::uint32_t> vertices_;  // positions that are drawn
    std::vector<glm::uvec3> triangles_;    // of vertices_
    std::vector<Point> points_;
    std::vector<std::uint8_t> isFixed_;  // by vertex
    std::vector<glm::dvec3> normals_;    // by vertex, unit
    std::vector<double> reach_, moves_;  // by vertex, along its normal: at most, and as it is
};

}  // namespace

std::vector<MovedVertex> fitSurface(BlockMesh& mesh, std::span<const MeshTriangle> original,
                                    std::span<const glm::uvec3> drawn, Numbering& numbering) {
    return SurfaceFit(mesh, original, drawn, numbering).run();
}

}  // namespace fb
