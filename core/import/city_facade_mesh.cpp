// A facade sheet as a scanner sees it: a grid of samples whose depths follow the design, with the noise of a
// scan.
#include <algorithm>
#include <cmath>

#include "import/city_facade.h"
#include "import/city_noise.h"

namespace fb::city {
namespace {

// Lines [first, last) of those whose `at` lies between low and high. Flaps and the parapet do not count.
struct LineRange {
    std::size_t first = 0, last = 0;
};

LineRange linesBetween(const std::vector<GridLine>& lines, double low, double high) {
    const auto inside = [&](const GridLine& line) {
        return line.inset == 0.0 && line.at > low && line.at < high;
    };
    const auto begin = std::find_if(lines.begin(), lines.end(), inside);
    const auto end = std::find_if_not(begin, lines.end(), inside);
    return {static_cast<std::size_t>(begin - lines.begin()), static_cast<std::size_t>(end - lines.begin())};
}

// Depth in front of the wall plane (negative behind it) of each sample, row by row.
struct DepthGrid {
    std::size_t columns = 0;
    std::vector<float> depth;

    float& at(std::size_t row, std::size_t column) { return depth[row * columns + column]; }
};

struct DepthShaper {
    const Facade& facade;
    const FacadeGrid& grid;
    DepthGrid depths;

    void relief(const Relief& r) {
        LineRange columns = linesBetween(grid.columns, -1.0, facade.length() + 1.0);
        const LineRange rows = linesBetween(grid.rows, r.at.y0 / 10.0, r.at.y1 / 10.0);
        if (r.segment != kAllRound) {
            const double start = facade.starts[r.segment];
            columns = linesBetween(grid.columns, start + r.at.s0 / 10.0, start + r.at.s1 / 10.0);
        }
        for (std::size_t row = rows.first; row < rows.last; ++row) {
            const double t = (grid.rows[row].at - r.at.y0 / 10.0) * 10.0 / (r.at.y1 - r.at.y0);
            const auto depth = static_cast<float>(r.depthLow + (r.depthHigh - r.depthLow) * t);
            for (std::size_t c = columns.first; c < columns.last; ++c) {
                depths.at(row, c) = std::max(depths.at(row, c), depth);
            }
        }
    }

    void opening(const Opening& o) {
        const double start = facade.starts[o.segment];
        const LineRange columns = linesBetween(grid.columns, start + o.at.s0 / 10.0, start + o.at.s1 / 10.0);
        const LineRange rows = linesBetween(grid.rows, o.at.y0 / 10.0, o.at.y1 / 10.0);
        for (std::size_t row = rows.first; row < rows.last; ++row) {
            for (std::size_t c = columns.first; c < columns.last; ++c) {
                // Panes return fewer and worse samples than walls.
                const float pane =
                    0.012f * signedUnit(latticeHash(facade.seed + 5, static_cast<std::int32_t>(c),
                                                    static_cast<std::int32_t>(row)));
                depths.at(row, c) -= static_cast<float>(o.depth) - pane;
            }
        }
    }
};

DepthGrid shapeDepths(const Facade& facade, const FacadeGrid& grid, Detail detail) {
    DepthShaper shaper{facade, grid, {}};
    shaper.depths.columns = grid.columns.size();
    shaper.depths.depth.assign(grid.columns.size() * grid.rows.size(), 0.0f);
    if (detail == Detail::flat) return std::move(shaper.depths);
    const auto shownHere = [&](const Relief& r) { return detail == Detail::all || !r.fine; };
    for (const Relief& r : facade.reliefs) {
        if (r.kind < ReliefKind::balcony && shownHere(r)) shaper.relief(r);
    }
    for (const Opening& o : facade.openings) shaper.opening(o);
    for (const Relief& r : facade.reliefs) {
        if (r.kind >= ReliefKind::balcony && shownHere(r)) shaper.relief(r);
    }
    return std::move(shaper.depths);
}

// Where a column stands in plan, and which way its samples move when they come out of the wall.
struct ColumnPlace {
    glm::dvec2 base, out;
};

ColumnPlace placeColumn(const Facade& f, const GridLine& line) {
    const int segments = f.segments();
    if (line.corner >= 0) {
        const glm::dvec2 before = f.normals[std::max(0, line.corner - 1)];
        const glm::dvec2 after = f.normals[std::min(segments - 1, line.corner)];
        return {f.line[line.corner], (before + after) / (1.0 + glm::dot(before, after))};
    }
    int segment = 0;
    while (segment + 1 < segments && f.starts[segment + 1] <= line.at) ++segment;
    const double length = f.starts[segment + 1] - f.starts[segment];
    const glm::dvec2 along = (f.line[segment + 1] - f.line[segment]) / length;
    return {f.line[segment] + along * (line.at - f.starts[segment]), f.normals[segment]};
}

}  // namespace

void addFacade(const Facade& facade, const FacadeGrid& grid, Detail detail, std::uint32_t material,
               bool textured, MeshBuilder& mesh) {
    DepthGrid depths = shapeDepths(facade, grid, detail);
    std::vector<ColumnPlace> places;
    std::vector<float> drift;  // of the scanner from one vertical scan to the next
    places.reserve(grid.columns.size());
    for (std::size_t c = 0; c < grid.columns.size(); ++c) {
        places.push_back(placeColumn(facade, grid.columns[c]));
        drift.push_back(0.003f * signedUnit(latticeHash(facade.seed + 6, static_cast<std::int32_t>(c), 0)));
    }
    // Walls between buildings never fall short of their plane, so that no slit opens where two stand back to
    // back.
    const double bulge = facade.role == FacadeRole::front ? 0.0 : 0.014;
    const std::size_t last = grid.columns.size() - 1;
    std::vector<std::uint32_t> below(grid.columns.size()), row(grid.columns.size());
    for (std::size_t r = 0; r < grid.rows.size(); ++r) {
        const GridLine& rowLine = grid.rows[r];
        const auto v = static_cast<float>(1.0 - rowLine.textureAt / grid.textureHeight());
        for (std::size_t c = 0; c <= last; ++c) {
            const GridLine& columnLine = grid.columns[c];
            double depth = depths.at(r, c);
            const bool end = columnLine.corner == 0 || columnLine.corner == facade.segments();
            if (columnLine.inset == 0.0 && !end) {
                depth += bulge + 0.007 * smoothNoise(facade.seed + 7, columnLine.at, rowLine.at, 1.6) +
                         drift[c] +
                         0.004 * signedUnit(latticeHash(facade.seed + 8, static_cast<std::int32_t>(c),
                                                        static_cast<std::int32_t>(r)));
            }
            const glm::dvec2 plan =
                places[c].base + places[c].out * (depth - columnLine.inset - rowLine.inset);
            const auto u = static_cast<float>(columnLine.textureAt / grid.textureWidth());
            const glm::vec2 uv = textured ? glm::vec2(u, v) : glm::vec2(0.0f);
            row[c] = mesh.addVertex({plan.x, rowLine.at, plan.y}, uv);
        }
        for (std::size_t c = 0; r > 0 && c < last; ++c) {
            mesh.addQuad(below[c], below[c + 1], row[c + 1], row[c], material);
        }
        below.swap(row);
    }
}

}  // namespace fb::city
