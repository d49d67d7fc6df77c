#include <algorithm>
#include <cmath>

#include "import/import_files.h"
#include "import/split_blocks.h"

namespace fb {
namespace {

constexpr std::uint64_t kMaxCells = std::uint64_t{1} << 22;
constexpr int kTrials = 12;

struct Grid {
    std::uint64_t columns = 1, rows = 1;
    glm::dvec2 low{0.0}, size{0.0};

    [[nodiscard]] std::uint64_t cells() const { return columns * rows; }
    [[nodiscard]] std::uint32_t cellOf(const glm::dvec2& p) const {
        const auto along = [](double at, double length, std::uint64_t count) {
            const double part = length > 0.0 ? at / length * static_cast<double>(count) : 0.0;
            return std::min(static_cast<std::uint64_t>(std::max(part, 0.0)), count - 1);
        };
        return static_cast<std::uint32_t>(along(p.y - low.y, size.y, rows) * columns +
                                          along(p.x - low.x, size.x, columns));
    }
};

std::vector<glm::dvec2> groundCentroids(const SourceMesh& mesh, UpAxis up) {
    std::vector<glm::dvec2> centroids;
    centroids.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 c = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0;
        centroids.emplace_back(c.x, up == UpAxis::z ? c.y : c.z);
    }
    return centroids;
}

// About `cells` cells, as square as whole numbers of them allow.
Grid gridOf(const glm::dvec2& low, const glm::dvec2& size, double cells) {
    Grid grid{1, 1, low, size};
    const auto whole = [](double value) {
        return static_cast<std::uint64_t>(std::clamp(std::round(value), 1.0, static_cast<double>(kMaxCells)));
    };
    if (size.x > 0.0 && size.y > 0.0) {
        grid.columns = whole(std::sqrt(cells * size.x / size.y));
        grid.rows = std::min(whole(cells / static_cast<double>(grid.columns)), kMaxCells / grid.columns);
    } else if (size.x > 0.0) {
        grid.columns = whole(cells);
    } else if (size.y > 0.0) {
        grid.rows = whole(cells);
    }
    return grid;
}

std::uint64_t occupiedCells(const Grid& grid, const std::vector<glm::dvec2>& centroids) {
    std::vector<bool> occupied(grid.cells(), false);
    std::uint64_t count = 0;
    for (const glm::dvec2& c : centroids) {
        const std::uint32_t cell = grid.cellOf(c);
        if (!occupied[cell]) ++count;
        occupied[cell] = true;
    }
    return count;
}

// Raises the number of cells until about `wanted` of them have triangles: a city does not fill its bounding
// square.
Grid chooseGrid(const std::vector<glm::dvec2>& centroids, double wanted) {
    glm::dvec2 low = centroids.front(), high = low;
    for (const glm::dvec2& c : centroids) {
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    Grid best = gridOf(low, high - low, wanted);
    double bestOff = std::abs(std::log(static_cast<double>(occupiedCells(best, centroids)) / wanted));
    double cells = wanted;
    for (int trial = 1; trial < kTrials && bestOff > 0.02; ++trial) {
        const Grid last = gridOf(low, high - low, cells);
        cells = std::min(cells * wanted / static_cast<double>(occupiedCells(last, centroids)),
                         static_cast<double>(kMaxCells));
        const Grid grid = gridOf(low, high - low, cells);
        const double off = std::abs(std::log(static_cast<double>(occupiedCells(grid, centroids)) / wanted));
        if (off < bestOff) {
            best = grid;
            bestOff = off;
        }
    }
    return best;
}

}  // namespace

std::vector<SourceBlock> splitOnGroundGrid(SourceBlock&& block, UpAxis up, std::uint64_t trianglesPerBlock) {
    const std::size_t triangles = block.mesh.triangles.size();
    const double wanted = std::round(static_cast<double>(triangles) /
                                     static_cast<double>(std::max<std::uint64_t>(trianglesPerBlock, 1)));
    if (triangles == 0) return {};
    if (wanted < 2.0) return {withoutUnused(block)};
    const std::vector<glm::dvec2> centroids = groundCentroids(block.mesh, up);
    const Grid grid = chooseGrid(centroids, wanted);
    std::vector<std::uint32_t> labels;
    labels.reserve(triangles);
    for (const glm::dvec2& c : centroids) labels.push_back(grid.cellOf(c));
    return splitByLabel(block, {labels, grid.cells(), [&](std::size_t cell) {
                                    return block.name + " row " + std::to_string(cell / grid.columns) +
                                           " column " + std::to_string(cell % grid.columns);
                                }});
}

}  // namespace fb
