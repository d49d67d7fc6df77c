#include "build/terrain_error.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "base/triangle_tree.h"

namespace fb {
namespace {

constexpr std::uint32_t kWindowCells = 256;

struct TileEdge {
    std::uint32_t a, b;
    bool free = false;  // beside a hole: only one triangle has it, and it is not on the tile's border
};

struct WindowError {
    double vertical = 0.0, uncovered = 0.0, partCellWidth = 0.0;

    void grow(const WindowError& other) {
        vertical = std::max(vertical, other.vertical);
        uncovered = std::max(uncovered, other.uncovered);
        partCellWidth = std::max(partCellWidth, other.partCellWidth);
    }
};

std::vector<TileEdge> edgesOf(const TileMesh& tile) {
    std::vector<std::uint64_t> keys;
    for (const glm::uvec3& t : tile.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            keys.push_back(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b));
        }
    }
    std::sort(keys.begin(), keys.end());
    std::vector<TileEdge> edges;
    for (std::size_t i = 0; i < keys.size();) {
        std::size_t end = i + 1;
        while (end < keys.size() && keys[end] == keys[i]) ++end;
        edges.push_back(
            {static_cast<std::uint32_t>(keys[i] >> 32), static_cast<std::uint32_t>(keys[i]), end - i == 1});
        i = end;
    }
    return edges;
}

// What all windows of a tile share.
struct TileFacts {
    const TileMesh& tile;
    std::vector<TileEdge> edges;
    TriangleTree tree;
};

TriangleTree treeOf(const TileMesh& tile, const glm::dvec3& corner) {
    std::vector<TriangleCorners> triangles;
    for (const glm::uvec3& t : tile.triangles) {
        TriangleCorners corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = glm::vec3(tile.vertices[t[static_cast<int>(k)]].place() - corner);
        triangles.push_back(corners);
    }
    return TriangleTree(std::move(triangles));
}

class WindowMeasure {
  public:
    WindowMeasure(const TerrainGrid& grid, const TileFacts& facts, const glm::dvec3& corner,
                  std::uint32_t column, std::uint32_t row)
        : grid_(grid), facts_(facts), tile_(facts.tile), corner_(corner), c0_(column), r0_(row) {
        c1_ = std::min(column + kWindowCells, tile_.lastColumn);
        r1_ = std::min(row + kWindowCells, tile_.lastRow);
    }

    Result<WindowError> run(const TerrainHeights& heights) {
        window_ = {std::int64_t{c0_} - 1, std::int64_t{r0_} - 1, c1_ - c0_ + 2, r1_ - r0_ + 2, {}};
        if (Result<void> read = heights.read(0, window_); !read) return passOn(read);
        covered_.assign(std::size_t{c1_ - c0_ + 1} * (r1_ - r0_ + 1), 0);
        for (const glm::uvec3& t : tile_.triangles) measureSamples(t);
        for (const TileEdge& edge : facts_.edges) measureEdge(edge);
        measureUncovered();
        return error_;
    }

  private:
    [[nodiscard]] double across(std::uint32_t c) const { return grid_.across[c]; }
    [[nodiscard]] double down(std::uint32_t r) const { return grid_.down[r]; }
    [[nodiscard]] bool cell(std::uint32_t c, std::uint32_t r) const { return window_.at(c, r).cell(); }
    [[nodiscard]] double height(std::uint32_t c, std::uint32_t r) const { return window_.at(c, r).height(); }

    // First and last column (row) of the window within [low, high]; none: first > last.
    static std::pair<std::uint32_t, std::uint32_t> within(const std::vector<std::int32_t>& places,
                                                          std::uint32_t from, std::uint32_t to, double low,
                                                          double high) {
        const auto begin = places.begin() + from, end = places.begin() + to + 1;
        const auto first = std::lower_bound(begin, end, low, [](std::int32_t p, double v) { return p < v; });
        const auto last = std::upper_bound(first, end, high, [](double v, std::int32_t p) { return v < p; });
        const auto firstAt = static_cast<std::uint32_t>(first - places.begin());
        const auto count = static_cast<std::uint32_t>(last - first);
        return count == 0 ? std::pair{std::uint32_t{1}, std::uint32_t{0}}
                          : std::pair{firstAt, firstAt + count - 1};
    }

    void measureSamples(const glm::uvec3& t) {
        const TileVertex* v[3] = {&tile_.vertices[t.x], &tile_.vertices[t.y], &tile_.vertices[t.z]};
        const auto [lowA, highA] = std::minmax({v[0]->across, v[1]->across, v[2]->across});
        const auto [lowD, highD] = std::minmax({v[0]->down, v[1]->down, v[2]->down});
        const auto [firstR, lastR] = within(grid_.down, r0_, r1_, lowD, highD);
        if (firstR > lastR) return;
        const double ba = v[1]->across - v[0]->across, bd = v[1]->down - v[0]->down,
                     bh = v[1]->height - v[0]->height;
        const double ca = v[2]->across - v[0]->across, cd = v[2]->down - v[0]->down,
                     ch = v[2]->height - v[0]->height;
        const double area = ba * cd - bd * ca;
        const double slopeA = (bh * cd - bd * ch) / area, slopeD = (ba * ch - bh * ca) / area;
        for (std::uint32_t r = firstR; r <= lastR; ++r) {
            // The row's part of the triangle, a little widened; whether a sample is inside is decided
            // exactly.
            double low = highA, high = lowA;
            for (int k = 0; k < 3; ++k) {
                const TileVertex &p = *v[k], &q = *v[(k + 1) % 3];
                const double y = down(r);
                if (y < std::min(p.down, q.down) || y > std::max(p.down, q.down)) continue;
                const double x0 = p.across, x1 = q.across;
                const double at = p.down == q.down ? x0 : x0 + (x1 - x0) * (y - p.down) / (q.down - p.down);
                low = std::min({low, at, p.down == q.down ? x1 : at});
                high = std::max({high, at, p.down == q.down ? x1 : at});
            }
            const auto [firstC, lastC] = within(grid_.across, c0_, c1_, low - 1.0, high + 1.0);
            for (std::uint32_t c = firstC; c <= lastC; ++c) {
                if (!inside(v, c, r)) continue;
                covered_[coveredAt(c, r)] = 1;
                if (!window_.at(c, r).known()) continue;
                const double drawn =
                    v[0]->height + slopeA * (across(c) - v[0]->across) + slopeD * (down(r) - v[0]->down);
                error_.vertical = std::max(error_.vertical, std::abs(height(c, r) - drawn));
            }
        }
    }
    [[nodiscard]] std::size_t coveredAt(std::uint32_t c, std::uint32_t r) const {
        return std::size_t{r - r0_} * (c1_ - c0_ + 1) + (c - c0_);
    }
    [[nodiscard]] bool inside(const TileVertex* const v[3], std::uint32_t c, std::uint32_t r) const {
        for (int k = 0; k < 3; ++k) {
            const TileVertex &p = *v[k], &q = *v[(k + 1) % 3];
            const std::int64_t side = std::int64_t{q.across - p.across} * (grid_.down[r] - p.down) -
                                      std::int64_t{q.down - p.down} * (grid_.across[c] - p.across);
            if (side > 0) return false;
        }
        return true;
    }

    // The map's surface within the cell of (c, r).
    [[nodiscard]] double surface(std::uint32_t c, std::uint32_t r, double u, double v) const {
        const double a = height(c, r), d = height(c + 1, r + 1);
        if (v >= u) {
            const double below = height(c, r + 1);
            return a + (below - a) * v + (d - below) * u;
        }
        const double right = height(c + 1, r);
        return a + (right - a) * u + (d - right) * v;
    }
    [[nodiscard]] double cellWidth(std::uint32_t c, std::uint32_t r) const {
        const double a = across(c + 1) - across(c), d = down(r + 1) - down(r);
        const auto [low, high] =
            std::minmax({height(c, r), height(c + 1, r), height(c, r + 1), height(c + 1, r + 1)});
        return std::sqrt(a * a + d * d + (high - low) * (high - low));
    }

    // Along grid lines both surfaces are linear between samples, which measureSamples() has looked at.
    void measureEdge(const TileEdge& edge) {
        const TileVertex &p = tile_.vertices[edge.a], &q = tile_.vertices[edge.b];
        if (p.across == q.across || p.down == q.down) return;
        const glm::dvec2 from(p.across, p.down), way(q.across - p.across, q.down - p.down);
        const double climb = q.height - p.height;
        // The part inside the window.
        double t0 = 0.0, t1 = 1.0;
        const auto clip = [&](double start, double step, double low, double high) {
            const double a = (low - start) / step, b = (high - start) / step;
            t0 = std::max(t0, std::min(a, b));
            t1 = std::min(t1, std::max(a, b));
        };
        clip(from.x, way.x, across(c0_), across(c1_));
        clip(from.y, way.y, down(r0_), down(r1_));
        if (!(t0 < t1)) return;
        places_.assign({t0, t1});
        const auto cross = [&](const std::vector<std::int32_t>& lines, std::uint32_t first,
                               std::uint32_t last, int axis) {
            const double a = from[axis] + way[axis] * t0, b = from[axis] + way[axis] * t1;
            const auto [begin, end] = within(lines, first, last, std::min(a, b), std::max(a, b));
            for (std::uint32_t i = begin; i <= end; ++i) {
                const double t = (lines[i] - from[axis]) / way[axis];
                if (t > t0 && t < t1) places_.push_back(t);
            }
        };
        cross(grid_.across, c0_, c1_, 0);
        cross(grid_.down, r0_, r1_, 1);
        std::sort(places_.begin(), places_.end());
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            const double a = places_[i], b = places_[i + 1];
            if (a == b) continue;
            const glm::dvec2 middle = from + way * (0.5 * (a + b));
            const std::uint32_t c = cellOf(grid_.across, c0_, c1_, middle.x),
                                r = cellOf(grid_.down, r0_, r1_, middle.y);
            if (!cell(c, r)) continue;
            if (edge.free) error_.partCellWidth = std::max(error_.partCellWidth, cellWidth(c, r));
            const auto local = [&](double t) {
                const glm::dvec2 at = from + way * t;
                return glm::dvec2((at.x - across(c)) / (across(c + 1) - across(c)),
                                  (at.y - down(r)) / (down(r + 1) - down(r)));
            };
            const auto look = [&](double t) {
                const glm::dvec2 at = local(t);
                error_.vertical =
                    std::max(error_.vertical, std::abs(surface(c, r, at.x, at.y) - (p.height + climb * t)));
            };
            look(a);
            look(b);
            const glm::dvec2 atA = local(a), atB = local(b);
            const double sideA = atA.x - atA.y, sideB = atB.x - atB.y;
            if ((sideA < 0.0) != (sideB < 0.0)) look(a + (b - a) * (sideA / (sideA - sideB)));
        }
    }
    static std::uint32_t cellOf(const std::vector<std::int32_t>& places, std::uint32_t first,
                                std::uint32_t last, double at) {
        const auto end = places.begin() + last;
        const auto above = std::upper_bound(places.begin() + first + 1, end, at,
                                            [](double v, std::int32_t p) { return v < p; });
        return static_cast<std::uint32_t>(above - places.begin()) - 1;
    }

    void measureUncovered() {
        for (std::uint32_t r = r0_; r <= r1_; ++r) {
            for (std::uint32_t c = c0_; c <= c1_; ++c) {
                if (covered_[coveredAt(c, r)] != 0) continue;
                double width = 0.0;
                for (std::uint32_t y = r > r0_ ? r - 1 : r; y <= r && y < r1_; ++y) {
                    for (std::uint32_t x = c > c0_ ? c - 1 : c; x <= c && x < c1_; ++x) {
                        if (cell(x, y)) width = std::max(width, cellWidth(x, y));
                    }
                }
                if (width == 0.0) continue;  // part of no cell of this window
                const glm::vec3 at(glm::dvec3(across(c), height(c, r), down(r)) - corner_);
                const double distance =
                    std::sqrt(static_cast<double>(facts_.tree.closest(at).squaredDistance));
                error_.uncovered = std::max(error_.uncovered, distance * (1.0 + 1e-5) + 1.0 + width);
            }
        }
    }

    const TerrainGrid& grid_;
    const TileFacts& facts_;
    const TileMesh& tile_;
    glm::dvec3 corner_;
    std::uint32_t c0_, r0_, c1_ = 0, r1_ = 0;  // samples, both included
    HeightWindow window_;
    std::vector<std::uint8_t> covered_;
    std::vector<double> places_;
    WindowError error_;
};

}  // namespace

Result<double> terrainError(const TerrainHeights& heights, const TerrainGrid& grid, const TileMesh& tile) {
    const glm::dvec3 corner(grid.across[tile.firstColumn], tile.vertices.front().height,
                            grid.down[tile.firstRow]);
    TileFacts facts{tile, edgesOf(tile), treeOf(tile, corner)};
    for (TileEdge& edge : facts.edges) {
        const TileVertex &a = tile.vertices[edge.a], &b = tile.vertices[edge.b];
        // On the border, which neighbours carry on; along it edges follow grid lines.
        if (a.column == b.column || a.row == b.row) edge.free = false;
    }
    const std::uint32_t wide = (tile.lastColumn - tile.firstColumn + kWindowCells - 1) / kWindowCells;
    const std::uint32_t high = (tile.lastRow - tile.firstRow + kWindowCells - 1) / kWindowCells;
    WindowError total;
    std::optional<Error> fault;
    std::mutex mutex;
    tbb::parallel_for(std::uint64_t{0}, std::uint64_t{wide} * high, [&](std::uint64_t i) {
        WindowMeasure measure(grid, facts, corner,
                              tile.firstColumn + static_cast<std::uint32_t>(i % wide) * kWindowCells,
                              tile.firstRow + static_cast<std::uint32_t>(i / wide) * kWindowCells);
        Result<WindowError> error = measure.run(heights);
        const std::scoped_lock lock(mutex);
        if (error)
            total.grow(*error);  // a maximum: the same in any order
        else
            fault = std::move(error.error());
    });
    if (fault) return tl::make_unexpected(std::move(*fault));
    const double part = total.partCellWidth > 0.0 ? total.vertical + total.partCellWidth : 0.0;
    const double error = std::max({total.vertical, total.uncovered, part});
    // Rounding in the formulas above, far below a thousandth of a grid unit.
    return error > 0.0 ? error * (1.0 + 1e-9) + 1e-3 : 0.0;
}

}  // namespace fb
