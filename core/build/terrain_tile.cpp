#include "build/terrain_tile.h"

#include <algorithm>
#include <cmath>

#include "build/simplify_height_field.h"
#include "build/simplify_level.h"

namespace fb {
namespace {

constexpr std::uint32_t kUnused = ~std::uint32_t{0};
class TileMaker {
  public:
    TileMaker(const TerrainBuild& build, const TerrainTile& tile) : build_(build), tile_(tile) {
        stride_ = build.layout.strideExponent(tile.level);
        const std::uint32_t cells = build.layout.shapeCells(tile.level);
        column_ = tile.x * cells;
        row_ = tile.y * cells;
        wide_ = std::min(cells, build.heights.columns(stride_) - 1 - column_);
        high_ = std::min(cells, build.heights.rows(stride_) - 1 - row_);
        isLeaf_ = tile.level == build.layout.depth;
        // Normals look as far as coarse triangles are wide.
        reach_ = isLeaf_ ? 1u : std::max(1u, cells / (2 * build.layout.leafCells()));
    }

    Result<TileMesh> run() {
        window_ = {std::int64_t{column_} - reach_,
                   std::int64_t{row_} - reach_,
                   wide_ + 1 + 2 * reach_,
                   high_ + 1 + 2 * reach_,
                   {}};
        if (Result<void> read = build_.heights.read(stride_, window_); !read) return passOn(read);
        mesh_.firstColumn = fineOf(column_, build_.grid.columns);
        mesh_.lastColumn = fineOf(column_ + wide_, build_.grid.columns);
        mesh_.firstRow = fineOf(row_, build_.grid.rows);
        mesh_.lastRow = fineOf(row_ + high_, build_.grid.rows);
        merged_.resize(std::size_t{wide_ + 1} * (high_ + 1));
        for (std::uint32_t i = 0; i < merged_.size(); ++i) merged_[i] = i;
        if (Result<void> bordered = setBorders(); !bordered) return passOn(bordered);
        std::vector<glm::uvec3> triangles = cellTriangles();
        takeVertices(triangles);
        if (!isLeaf_) simplify();
        for (TileVertex& vertex : mesh_.vertices) vertex.normal = normalAt(vertex);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] std::uint32_t fineOf(std::uint32_t sample, std::uint32_t count) const {
        return static_cast<std::uint32_t>(
            std::min<std::uint64_t>(std::uint64_t{sample} << stride_, count - 1));
    }
    [[nodiscard]] std::uint32_t local(std::uint32_t i, std::uint32_t j) const { return j * (wide_ + 1) + i; }
    [[nodiscard]] const HeightSample& sample(std::uint32_t i, std::uint32_t j) const {
        return window_.at(std::int64_t{column_} + i, std::int64_t{row_} + j);
    }

    // Above, left, right, below.
    Result<void> setBorders() {
        mesh_.sides = {BorderSide{tile_.level, false, tile_.y, tile_.x},
                       BorderSide{tile_.level, true, tile_.x, tile_.y},
                       BorderSide{tile_.level, true, tile_.x + 1, tile_.y},
                       BorderSide{tile_.level, false, tile_.y + 1, tile_.x}};
        for (std::size_t s = 0; s < 4; ++s) {
            Result<std::vector<BorderPoint>> line =
                borderOf(build_.heights, build_.grid, build_.layout, mesh_.sides[s]);
            if (!line) return passOn(line);
            mesh_.borders[s] = std::move(*line);
            if (!isLeaf_) mergeBorder(s);
        }
        return {};
    }

    // Border samples that are not kept become the nearest kept one; of two as near the one at the tile's
    // corner.
    void mergeBorder(std::size_t s) {
        const bool vertical = mesh_.sides[s].vertical, far = s >= 2;
        const std::uint32_t count = vertical ? high_ : wide_;
        const auto localAt = [&](std::uint32_t n) {
            return vertical ? local(far ? wide_ : 0, n) : local(n, far ? high_ : 0);
        };
        const std::vector<std::int32_t>& places = vertical ? build_.grid.down : build_.grid.across;
        const std::uint32_t first = vertical ? row_ : column_;
        const auto placeAt = [&](std::uint32_t n) {
            return places[std::min<std::size_t>(std::size_t{first + n} << stride_, places.size() - 1)];
        };
        std::vector<std::uint32_t> kept;
        std::size_t next = 0;
        for (std::uint32_t n = 0; n <= count; ++n) {
            if (next < mesh_.borders[s].size() && mesh_.borders[s][next].place == placeAt(n))
                kept.push_back(n), ++next;
        }
        for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
            for (std::uint32_t n = kept[k] + 1; n < kept[k + 1]; ++n) {
                const std::uint32_t before = n - kept[k], after = kept[k + 1] - n;
                const bool back = before < after || (before == after && kept[k + 1] != count);
                merged_[localAt(n)] = localAt(back ? kept[k] : kept[k + 1]);
            }
        }
    }

    [[nodiscard]] std::vector<glm::uvec3> cellTriangles() const {
        std::vector<glm::uvec3> triangles;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const glm::uvec3 t(merged_[a], merged_[b], merged_[c]);
            if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
        };
        for (std::uint32_t j = 0; j < high_; ++j) {
            for (std::uint32_t i = 0; i < wide_; ++i) {
                if (!sample(i, j).cell()) continue;
                const std::uint32_t a = local(i, j), b = local(i + 1, j), c = local(i, j + 1),
                                    d = local(i + 1, j + 1);
                add(a, c, d);
                add(a, d, b);
            }
        }
        return triangles;
    }

    void takeVertices(const std::vector<glm::uvec3>& triangles) {
        std::vector<std::uint32_t> number(merged_.size(), kUnused);
        for (const glm::uvec3& t : triangles) {
            glm::uvec3 numbered;
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& n = number[t[k]];
                if (n == kUnused) {
                    n = static_cast<std::uint32_t>(mesh_.vertices.size());
                    mesh_.vertices.push_back(vertexAt(t[k] % (wide_ + 1), t[k] / (wide_ + 1)));
                }
                numbered[k] = n;
            }
            mesh_.triangles.push_back(numbered);
        }
    }

    [[nodiscard]] TileVertex vertexAt(std::uint32_t i, std::uint32_t j) const {
        TileVertex vertex;
        vertex.column = fineOf(column_ + i, build_.grid.columns);
        vertex.row = fineOf(row_ + j, build_.grid.rows);
        vertex.across = build_.grid.across[vertex.column];
        vertex.down = build_.grid.down[vertex.row];
        vertex.height = sample(i, j).height();
        return vertex;
    }

    [[nodiscard]] bool onBorder(const TileVertex& v) const {
        return v.column == mesh_.firstColumn || v.column == mesh_.lastColumn || v.row == mesh_.firstRow ||
               v.row == mesh_.lastRow;
    }

    void simplify() {
        std::size_t border = 0;
        std::vector<HeightFieldPoint> points;
        for (const TileVertex& v : mesh_.vertices) {
            points.push_back({v.across, v.down, v.height, onBorder(v)});
            border += points.back().locked ? 1 : 0;
        }
        // In proportion to the part of the whole square that is there; no fewer than the locked border needs.
        const double whole =
            2.0 * build_.layout.shapeCells(tile_.level) * build_.layout.shapeCells(tile_.level);
        const double share = static_cast<double>(mesh_.triangles.size()) / whole;
        const auto wanted =
            static_cast<std::size_t>(std::ceil(share * static_cast<double>(build_.desiredTriangles)));
        const std::size_t aim = std::max({std::size_t{2}, wanted, border});
        const std::vector<glm::uvec3> simplified = simplifyHeightField(points, mesh_.triangles, aim);
        mesh_.stuck = static_cast<double>(simplified.size()) > kStuckFactor * static_cast<double>(aim);
        keepOnly(simplified);
    }

    void keepOnly(const std::vector<glm::uvec3>& triangles) {
        std::vector<std::uint32_t> number(mesh_.vertices.size(), kUnused);
        std::vector<TileVertex> vertices;
        mesh_.triangles = triangles;
        for (glm::uvec3& t : mesh_.triangles) {
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& n = number[t[k]];
                if (n == kUnused) {
                    n = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(mesh_.vertices[t[k]]);
                }
                t[k] = n;
            }
        }
        mesh_.vertices = std::move(vertices);
    }

    // From the known samples up to reach_ away to both sides. Samples beyond the tile count, so that
    // neighbours agree.
    [[nodiscard]] glm::vec3 normalAt(const TileVertex& vertex) const {
        const auto nearest = [&](std::uint32_t fine,
                                 std::uint32_t count) {  // the sample at the map's last place is the last
            return fine + 1 == count ? (std::int64_t{count} - 2 + (std::int64_t{1} << stride_)) >> stride_
                                     : std::int64_t{fine} >> stride_;
        };
        const std::int64_t c = nearest(vertex.column, build_.grid.columns),
                           r = nearest(vertex.row, build_.grid.rows);
        const auto slope = [&](bool vertical) {
            const std::vector<std::int32_t>& places = vertical ? build_.grid.down : build_.grid.across;
            const auto known = [&](std::int64_t by) -> const HeightSample* {
                const std::int64_t x = vertical ? c : c + by, y = vertical ? r + by : r;
                if (x < window_.column || y < window_.row || x >= window_.column + window_.columns ||
                    y >= window_.row + window_.rows) {
                    return nullptr;
                }
                const HeightSample& s = window_.at(x, y);
                return s.known() ? &s : nullptr;
            };
            const auto farthest = [&](std::int64_t sign) {
                std::int64_t by = 0;
                while (by < reach_ && known(sign * (by + 1)) != nullptr) ++by;
                return sign * by;
            };
            const std::int64_t low = farthest(-1), high = farthest(1);
            if (low == high) return 0.0;
            const auto placeAt = [&](std::int64_t by) {
                const auto n = static_cast<std::uint64_t>((vertical ? r : c) + by) << stride_;
                return places[std::min<std::uint64_t>(n, places.size() - 1)];
            };
            return static_cast<double>(known(high)->height() - known(low)->height()) /
                   (placeAt(high) - placeAt(low));
        };
        const glm::dvec3 normal(-slope(false), 1.0, -slope(true));
        return glm::vec3(normal / std::sqrt(glm::dot(normal, normal)));
    }

    const TerrainBuild& build_;
    const TerrainTile& tile_;
    std::uint32_t stride_ = 0, column_ = 0, row_ = 0, wide_ = 0, high_ = 0, reach_ = 1;
    bool isLeaf_ = false;
    HeightWindow window_;
    std::vector<std::uint32_t> merged_;  // by local sample: itself, or the border vertex it became
    TileMesh mesh_;
};

}  // namespace

Result<TileMesh> makeTile(const TerrainBuild& build, const TerrainTile& tile) {
    return TileMaker(build, tile).run();
}

}  // namespace fb
