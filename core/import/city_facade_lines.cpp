// The grid lines of a facade sheet: where features need them, and filled in between to the spacing of the
// scan.
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "import/city_facade.h"
#include "import/city_noise.h"

namespace fb::city {
namespace {

constexpr double kFlapMetres = 0.45;    // how far a sheet turns around its end
constexpr double kFlapSlant = 0.02;     // and how far it leaves the neighbour's plane meanwhile
constexpr double kParapetMetres = 0.3;  // thickness
constexpr double kStepTexture = 0.12;   // metres of texture for the two lines around an edge

bool shown(const Relief& relief, Detail detail) {
    return detail == Detail::all || (detail == Detail::coarse && !relief.fine);
}

// Edges of `segment` (columns) or of the whole sheet (rows), in decimetres, each once.
std::vector<int> edgesOf(const Facade& facade, Detail detail, int segment, bool columns) {
    std::vector<int> edges;
    if (detail == Detail::flat) return edges;
    const auto add = [&](int itsSegment, const DesignRect& at) {
        if (columns && itsSegment != segment) return;
        edges.push_back(columns ? at.s0 : at.y0);
        edges.push_back(columns ? at.s1 : at.y1);
    };
    for (const Opening& opening : facade.openings) add(opening.segment, opening.at);
    for (const Relief& relief : facade.reliefs) {
        if (shown(relief, detail)) add(relief.segment, relief.at);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

void addPairs(std::vector<GridLine>& lines, double start, const std::vector<int>& edges) {
    for (const int edge : edges) {
        lines.push_back({start + edge / 10.0 - kHalfStep, 0.0, 0.0, -1});
        lines.push_back({start + edge / 10.0 + kHalfStep, 0.0, 0.0, -1});
    }
}

// Texture metres: as long as the line on the wall, more across steps, the inset's length around ends.
void measureTexture(std::vector<GridLine>& lines) {
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const double along = std::abs(lines[i].at - lines[i - 1].at);
        const double inset = std::abs(lines[i].inset - lines[i - 1].inset);
        const bool step = along < 2.5 * kHalfStep && inset == 0.0;
        lines[i].textureAt = lines[i - 1].textureAt + std::max(step ? kStepTexture : along, inset);
    }
}

bool isFilled(const GridLine& a, const GridLine& b) {
    return a.inset == b.inset;
}

std::uint64_t partsOf(const GridLine& a, const GridLine& b, double spacing) {
    if (!isFilled(a, b)) return 1;
    return static_cast<std::uint64_t>(std::max(1.0, std::ceil(std::abs(b.at - a.at) / spacing)));
}

std::uint64_t countParts(const std::vector<GridLine>& lines, double spacing) {
    std::uint64_t parts = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) parts += partsOf(lines[i - 1], lines[i], spacing);
    return parts;
}

// Lines in between are a little irregular, as the stops of a scanner are.
std::vector<GridLine> fillLines(const std::vector<GridLine>& lines, double spacing, std::uint32_t seed) {
    std::vector<GridLine> filled{lines.front()};
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const GridLine &a = lines[i - 1], &b = lines[i];
        const auto parts = static_cast<int>(partsOf(a, b, spacing));
        for (int k = 1; k < parts; ++k) {
            const auto number = static_cast<std::int32_t>(filled.size());
            const double t = (k + 0.15 * signedUnit(latticeHash(seed, number, 7))) / parts;
            filled.push_back(
                {a.at + (b.at - a.at) * t, a.inset, a.textureAt + (b.textureAt - a.textureAt) * t, -1});
        }
        filled.push_back(b);
    }
    return filled;
}

}  // namespace

FacadeGrid featureGrid(const Facade& facade, Detail detail) {
    FacadeGrid grid;
    const double end = facade.length();
    if (facade.flaps) grid.columns.push_back({kFlapSlant, kFlapMetres, 0.0, -1});
    for (int k = 0; k < facade.segments(); ++k) {
        grid.columns.push_back({facade.starts[k], 0.0, 0.0, k});
        addPairs(grid.columns, facade.starts[k], edgesOf(facade, detail, k, true));
    }
    grid.columns.push_back({end, 0.0, 0.0, facade.segments()});
    if (facade.flaps) grid.columns.push_back({end - kFlapSlant, kFlapMetres, 0.0, -1});

    grid.rows.push_back({facade.bottom, 0.0, 0.0, -1});
    addPairs(grid.rows, 0.0, edgesOf(facade, detail, 0, false));
    grid.rows.push_back({facade.top, 0.0, 0.0, -1});
    grid.rows.push_back({facade.top, kParapetMetres, 0.0, -1});
    grid.rows.push_back({facade.wrapDown, kParapetMetres + 0.01, 0.0, -1});

    const std::size_t firstColumn = facade.flaps ? 1 : 0;
    for (std::size_t i = firstColumn + 1; i + firstColumn < grid.columns.size(); ++i) {
        FB_CHECK(grid.columns[i].at > grid.columns[i - 1].at);
    }
    for (std::size_t i = 1; i + 2 < grid.rows.size(); ++i) FB_CHECK(grid.rows[i].at > grid.rows[i - 1].at);
    measureTexture(grid.columns);
    measureTexture(grid.rows);
    return grid;
}

std::uint64_t countFilled(const FacadeGrid& features, double spacing) {
    return 2 * countParts(features.columns, spacing) * countParts(features.rows, spacing);
}

FacadeGrid fillGrid(const FacadeGrid& features, double spacing, std::uint32_t seed) {
    return {fillLines(features.columns, spacing, seed), fillLines(features.rows, spacing, seed + 1)};
}

}  // namespace fb::city
