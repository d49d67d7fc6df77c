#include "select/coverage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace fb {
namespace {

constexpr int kColumns = 64, kRows = 36;

struct Cells {
    int left = 0, right = kColumns, top = 0, bottom = kRows;  // right and bottom are not part of it
};

// Empty where the box is out of view.
std::optional<Cells> cellsOf(const View& view, const Box3f& box) {
    if (!meetsView(view, box)) return std::nullopt;
    const glm::dvec3 right = view.camera.right(), up = view.camera.up();
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        const glm::dvec3 q = p - view.camera.eye;
        const double depth = glm::dot(q, view.forward);
        if (depth <= view.camera.nearMetres) return Cells{};
        const double at[2] = {glm::dot(q, right) / depth * view.pixelsPerUnit / view.width + 0.5,
                              0.5 - glm::dot(q, up) / depth * view.pixelsPerUnit / view.height};
        for (int k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
        }
    }
    const auto cell = [](double at, int count) { return static_cast<int>(std::clamp(at, 0.0, 1.0) * count); };
    const auto end = [](double at, int count) {
        return static_cast<int>(std::ceil(std::clamp(at, 0.0, 1.0) * count));
    };
    return Cells{cell(low[0], kColumns), end(high[0], kColumns), cell(low[1], kRows), end(high[1], kRows)};
}

class Mask {
  public:
    explicit Mask(const View& view) : view_(view) {}
    void add(const Box3f& box) {
        const std::optional<Cells> cells = cellsOf(view_, box);
        if (!cells || cells->right <= cells->left) return;
        const int width = cells->right - cells->left;
        const std::uint64_t bits = (width == kColumns ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1)
                                   << cells->left;
        for (int row = cells->top; row < cells->bottom; ++row) rows_[static_cast<std::size_t>(row)] |= bits;
    }
    [[nodiscard]] double megapixels() const {
        int covered = 0;
        for (const std::uint64_t row : rows_) covered += std::popcount(row);
        return 1e-6 * view_.width * view_.height * covered / (kColumns * kRows);
    }

  private:
    const View& view_;
    std::array<std::uint64_t, kRows> rows_{};  // a bit a column
};

}  // namespace

double coveredMegapixels(const Hierarchy& hierarchy, std::span<const NodeId> nodes, const View& view) {
    Mask mask(view);
    for (const NodeId node : nodes) mask.add(hierarchy.bounds[node]);
    return mask.megapixels();
}

double megapixelsOfRoots(const Hierarchy& hierarchy, const View& view) {
    Mask mask(view);
    for (NodeId root = 0; root < hierarchy.rootCount; ++root) mask.add(hierarchy.bounds[root]);
    return mask.megapixels();
}

}  // namespace fb
