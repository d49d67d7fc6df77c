#include "build/terrain_heights.h"

#include <algorithm>
#include <span>
#include <string>

namespace fb {
namespace {

std::filesystem::path fileOf(const std::filesystem::path& folder, std::size_t level) {
    return folder / ("heights-" + std::to_string(level));
}

// Sets the cell bits of `row`, whose lower neighbour is `below`.
void markCells(std::span<HeightSample> row, std::span<const HeightSample> below) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        if (row[i].known() && row[i + 1].known() && below[i].known() && below[i + 1].known()) {
            row[i].bits |= HeightSample::kCell;
        }
    }
}

// The mean of the known samples around (c, r); unknown where there are none.
HeightSample meanAround(const HeightWindow& finer, std::int64_t c, std::int64_t r) {
    std::int64_t sum = 0, count = 0;
    for (std::int64_t y = r - 1; y <= r + 1; ++y) {
        for (std::int64_t x = c - 1; x <= c + 1; ++x) {
            const HeightSample& sample = finer.at(x, y);
            if (!sample.known()) continue;
            sum += sample.height();
            ++count;
        }
    }
    if (count == 0) return {};
    return {HeightSample::kKnown | static_cast<std::uint32_t>((sum + count / 2) / count)};
}

}  // namespace

Result<TerrainHeights> TerrainHeights::make(const TerrainSource& source, const TerrainGrid& grid,
                                            std::uint32_t levels, const std::filesystem::path& folder) {
    TerrainHeights made;
    Result<SquareWriter<HeightSample>> writer =
        SquareWriter<HeightSample>::create(fileOf(folder, 0), grid.columns);
    if (!writer) return passOn(writer);
    std::vector<HeightSample> above, row(grid.columns);
    Result<void> read = source.readHeights([&](std::uint32_t, std::span<const float> rows) -> Result<void> {
        for (std::size_t at = 0; at < rows.size(); at += grid.columns) {
            for (std::uint32_t i = 0; i < grid.columns; ++i) {
                const float height = rows[at + i];
                row[i].bits = height == height ? HeightSample::kKnown |
                                                     static_cast<std::uint32_t>(grid.heightUnits(height))
                                               : 0u;
            }
            if (!above.empty()) {
                markCells(above, row);
                if (Result<void> added = writer->add(above); !added) return added;
            }
            above = row;
        }
        return {};
    });
    if (!read) return passOn(read);
    if (Result<void> added = writer->add(above); !added) return passOn(added);
    Result<SquareFile<HeightSample>> file = writer->finish();
    if (!file) return passOn(file);
    made.levels_.push_back(std::move(*file));
    while (made.levels_.size() < levels) {
        if (Result<void> added = made.addCoarser(folder); !added) return passOn(added);
    }
    return made;
}

Result<void> TerrainHeights::addCoarser(const std::filesystem::path& folder) {
    const auto fine = static_cast<std::uint32_t>(levels_.size() - 1);
    const auto halved = [](std::uint32_t samples) { return samples / 2 + 1; };  // cells halved, rounded up
    const std::uint32_t fineColumns = columns(fine), fineRows = rows(fine);
    const std::uint32_t wide = halved(fineColumns), high = halved(fineRows);
    Result<SquareWriter<HeightSample>> writer =
        SquareWriter<HeightSample>::create(fileOf(folder, levels_.size()), wide);
    if (!writer) return passOn(writer);
    std::vector<HeightSample> row(wide);
    constexpr std::uint32_t kBand = kSquareSide / 2;
    for (std::uint32_t first = 0; first < high; first += kBand) {
        HeightWindow window{-1, std::int64_t{first} * 2 - 2, fineColumns + 2, kBand * 2 + 4, {}};
        if (Result<void> read = this->read(fine, window); !read) return read;
        for (std::uint32_t j = first; j < std::min(high, first + kBand); ++j) {
            const std::uint32_t r = std::min(2 * j, fineRows - 1);
            for (std::uint32_t i = 0; i < wide; ++i) {
                const std::uint32_t c = std::min(2 * i, fineColumns - 1);
                row[i] = window.at(c, r);
                row[i].bits &= ~HeightSample::kCell;
                if (!row[i].known()) row[i] = meanAround(window, c, r);
                const bool inside = i + 1 < wide && j + 1 < high;
                if (inside && (window.at(c, r).cell() || window.at(c + 1, r).cell() ||
                               window.at(c, r + 1).cell() || window.at(c + 1, r + 1).cell())) {
                    row[i].bits |= HeightSample::kCell;
                }
            }
            if (Result<void> added = writer->add(row); !added) return added;
        }
    }
    Result<SquareFile<HeightSample>> file = writer->finish();
    if (!file) return passOn(file);
    levels_.push_back(std::move(*file));
    return {};
}

}  // namespace fb
