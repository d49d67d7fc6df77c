#include "import/guess_up.h"

#include <algorithm>
#include <array>

#include "base/bounds.h"

namespace fb {
namespace {

constexpr double kLeastShare = 0.02;   // of all area: less is no sign
constexpr double kClearly = 3.0;       // times as much as along the other axis
constexpr double kLowest = 0.01;       // of the extent
constexpr double kStraightDown = -0.98;  // cosine

struct Signs {
    std::array<double, 2> open{}, base{};  // along y and z, as shares of all area
};

Signs readSigns(const SourceMesh& mesh) {
    Box3d bounds;
    for (const glm::dvec3& p : mesh.positions) bounds.grow(p);
    double total = 0.0;
    glm::dvec3 sum(0.0);
    Signs signs;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        const glm::dvec3 normal = glm::cross(b - a, c - a);  // twice the area long
        const double area = glm::length(normal);
        total += area;
        sum += normal;
        for (int axis = 1; axis <= 2; ++axis) {
            const double height = (a[axis] + b[axis] + c[axis]) / 3.0 - bounds.min[axis];
            const bool isLow = height <= kLowest * (bounds.max[axis] - bounds.min[axis]);
            if (isLow && normal[axis] < kStraightDown * area) signs.base[static_cast<std::size_t>(axis - 1)] += area;
        }
    }
    if (!(total > 0.0)) return {};
    signs.open = {sum.y / total, sum.z / total};
    for (double& share : signs.base) share /= total;
    return signs;
}

std::optional<UpAxis> clearOne(const std::array<double, 2>& shares) {
    const auto wins = [&](double share, double other) {
        return share > kLeastShare && share > kClearly * std::abs(other);
    };
    if (wins(shares[0], shares[1])) return UpAxis::y;
    if (wins(shares[1], shares[0])) return UpAxis::z;
    return std::nullopt;
}

}  // namespace

std::optional<UpGuess> guessUp(const SourceMesh& mesh) {
    const Signs signs = readSigns(mesh);
    if (const auto axis = clearOne(signs.open)) return UpGuess{*axis, "the surface is open below"};
    if (const auto axis = clearOne(signs.base)) return UpGuess{*axis, "the surface stands on a flat base"};
    return std::nullopt;
}

}  // namespace fb
