#include "build/terrain_border.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace fb {
namespace {

double lineAt(const BorderPoint& a, const BorderPoint& b, std::int32_t place) {
    return a.height + (static_cast<double>(b.height) - a.height) * (static_cast<double>(place) - a.place) /
                          (static_cast<double>(b.place) - a.place);
}

struct Stretch {
    std::size_t from, to, worst;
    double deviation;

    bool operator<(const Stretch& other) const {  // the queue's top is the largest; of equals the first
        return deviation != other.deviation ? deviation < other.deviation : from > other.from;
    }
};

Stretch stretchOf(const std::vector<BorderPoint>& line, std::size_t from, std::size_t to) {
    Stretch stretch{from, to, from, 0.0};
    for (std::size_t i = from + 1; i < to; ++i) {
        const double deviation = std::abs(line[i].height - lineAt(line[from], line[to], line[i].place));
        if (deviation > stretch.deviation) stretch.deviation = deviation, stretch.worst = i;
    }
    return stretch;
}

// Rounding onto the grid alone moves a straight line this far.
constexpr double kRoundingUnits = 1.0;

// Compares `own` with `other` over the stretches that both have; `acrossSide`: the other's side of the line.
void compareLines(const std::vector<BorderPoint>& own, const std::vector<BorderPoint>& other,
                  std::uint8_t acrossSide, std::uint8_t ownSide, BorderGaps& gaps) {
    std::size_t j = 0;
    for (std::size_t i = 0; i + 1 < own.size(); ++i) {
        if ((own[i].sides & ownSide) == 0) continue;
        while (j + 1 < other.size() && other[j + 1].place <= own[i].place) ++j;
        for (std::size_t k = j; k + 1 < other.size() && other[k].place < own[i + 1].place; ++k) {
            if ((other[k].sides & acrossSide) == 0) continue;
            for (const std::int32_t place :
                 {std::max(own[i].place, other[k].place), std::min(own[i + 1].place, other[k + 1].place)}) {
                const double mine = lineAt(own[i], own[i + 1], place),
                             theirs = lineAt(other[k], other[k + 1], place);
                gaps.reach[i] = std::min({gaps.reach[i], mine, theirs});
                gaps.widest = std::max(gaps.widest, std::abs(mine - theirs));
            }
        }
    }
}

}  // namespace

std::vector<std::uint8_t> keepOnBorder(const std::vector<BorderPoint>& line, std::uint32_t edges) {
    std::vector<std::uint8_t> kept(line.size(), 0);
    if (line.empty()) return kept;
    std::priority_queue<Stretch> stretches;
    std::size_t from = 0;
    std::uint32_t count = 0;
    kept[0] = 1;
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (i + 1 < line.size() && line[i].sides == line[i - 1].sides) continue;
        kept[i] = 1;
        if (line[i - 1].sides != 0) {
            stretches.push(stretchOf(line, from, i));
            ++count;
        }
        from = i;
    }
    while (!stretches.empty() && count < edges && stretches.top().deviation > kRoundingUnits) {
        const Stretch worst = stretches.top();
        stretches.pop();
        kept[worst.worst] = 1;
        stretches.push(stretchOf(line, worst.from, worst.worst));
        stretches.push(stretchOf(line, worst.worst, worst.to));
        ++count;
    }
    return kept;
}

std::uint32_t borderEdges(const TerrainLayout& layout, std::uint32_t level, std::uint32_t cells) {
    if (level == layout.depth) return cells;
    const std::uint64_t whole = layout.shapeCells(level);
    return static_cast<std::uint32_t>((std::uint64_t{layout.leafCells()} * cells + whole - 1) / whole);
}

Result<std::vector<BorderPoint>> borderOf(const TerrainHeights& heights, const TerrainGrid& grid,
                                          const TerrainLayout& layout, const BorderSide& side) {
    const std::uint32_t stride = layout.strideExponent(side.level), cells = layout.shapeCells(side.level);
    const std::uint32_t samples = side.vertical ? heights.rows(stride) : heights.columns(stride);
    const std::uint32_t first = side.along * cells;
    std::vector<BorderPoint> line;
    if (first + 1 >= samples) return line;
    const std::uint32_t count = std::min(cells, samples - 1 - first);
    // The map's last line lies at its end, wherever that is.
    const std::uint32_t lines = side.vertical ? heights.columns(stride) : heights.rows(stride);
    const std::int64_t at = std::min<std::int64_t>(std::int64_t{side.line} * cells, lines - 1);
    HeightWindow window = side.vertical ? HeightWindow{at - 1, first, 2, count + 1, {}}
                                        : HeightWindow{first, at - 1, count + 1, 2, {}};
    if (Result<void> read = heights.read(stride, window); !read) return passOn(read);
    const std::vector<std::int32_t>& places = side.vertical ? grid.down : grid.across;
    for (std::uint32_t i = 0; i <= count; ++i) {
        const std::int64_t n = std::int64_t{first} + i;
        const HeightSample& before = side.vertical ? window.at(at - 1, n) : window.at(n, at - 1);
        const HeightSample& after = side.vertical ? window.at(at, n) : window.at(n, at);
        const auto fine = static_cast<std::size_t>(
            std::min<std::uint64_t>(static_cast<std::uint64_t>(n) << stride, places.size() - 1));
        const auto sides =
            static_cast<std::uint8_t>((before.cell() ? kSideBefore : 0) | (after.cell() ? kSideAfter : 0));
        line.push_back({places[fine], after.height(), i < count ? sides : std::uint8_t{0}});
    }
    if (side.level == layout.depth) return line;
    const std::vector<std::uint8_t> kept = keepOnBorder(line, borderEdges(layout, side.level, count));
    std::size_t left = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (kept[i] != 0) line[left++] = line[i];
    }
    line.resize(left);
    return line;
}

Result<BorderGaps> borderGaps(const TerrainHeights& heights, const TerrainGrid& grid,
                              const TerrainLayout& layout, const BorderSide& side,
                              const std::vector<BorderPoint>& own) {
    BorderGaps gaps;
    gaps.reach.assign(own.size(), kNoNeighbour);
    if (side.line == 0 || own.empty()) return gaps;
    const auto compareBoth = [&](const std::vector<BorderPoint>& other) {
        compareLines(own, other, kSideAfter, kSideBefore, gaps);
        compareLines(own, other, kSideBefore, kSideAfter, gaps);
    };
    // Coarser neighbours: those whose border this is too.
    for (std::uint32_t level = side.level; level-- > 1;) {
        const std::uint32_t up = side.level - level;
        if ((side.line & ((1u << up) - 1)) != 0) break;
        Result<std::vector<BorderPoint>> other =
            borderOf(heights, grid, layout, {level, side.vertical, side.line >> up, side.along >> up});
        if (!other) return passOn(other);
        compareBoth(*other);
    }
    for (std::uint32_t level = side.level + 1; level <= layout.depth; ++level) {
        const std::uint32_t down = level - side.level;
        for (std::uint64_t i = 0; i < (std::uint64_t{1} << down); ++i) {
            const auto along = static_cast<std::uint32_t>((std::uint64_t{side.along} << down) + i);
            Result<std::vector<BorderPoint>> other =
                borderOf(heights, grid, layout, {level, side.vertical, side.line << down, along});
            if (!other) return passOn(other);
            if (other->empty()) break;
            compareBoth(*other);
        }
    }
    return gaps;
}

}  // namespace fb
