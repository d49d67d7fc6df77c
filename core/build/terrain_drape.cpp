#include "build/terrain_drape.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace fb {
namespace {

std::filesystem::path drapeFile(const std::filesystem::path& folder, std::size_t level) {
    return folder / ("drape-" + std::to_string(level));
}

}  // namespace

Result<TerrainDrape> TerrainDrape::make(const TerrainSource& source, const std::filesystem::path& folder) {
    TerrainDrape made;
    const TerrainInfo& info = source.info();
    if (!info.hasDrape()) return made;
    const auto columns = static_cast<std::uint32_t>(info.drapeWidth);
    Result<SquareWriter<DrapeTexel>> writer = SquareWriter<DrapeTexel>::create(drapeFile(folder, 0), columns);
    if (!writer) return passOn(writer);
    std::vector<DrapeTexel> row(columns);
    Result<void> read =
        source.readDrape([&](std::uint32_t, std::span<const std::uint8_t> rows) -> Result<void> {
            for (std::size_t at = 0; at < rows.size(); at += row.size() * 3) {
                std::memcpy(row.data(), rows.data() + at, row.size() * 3);
                if (Result<void> added = writer->add(row); !added) return added;
            }
            return {};
        });
    if (!read) return passOn(read);
    Result<SquareFile<DrapeTexel>> file = writer->finish();
    if (!file) return passOn(file);
    made.levels_.push_back(std::move(*file));
    while (made.levels_.back().columns() > 1 || made.levels_.back().rows() > 1) {
        if (Result<void> added = made.addCoarser(folder); !added) return passOn(added);
    }
    return made;
}

Result<void> TerrainDrape::addCoarser(const std::filesystem::path& folder) {
    const SquareFile<DrapeTexel>& fine = levels_.back();
    const std::uint32_t wide = (fine.columns() + 1) / 2, high = (fine.rows() + 1) / 2;
    Result<SquareWriter<DrapeTexel>> writer =
        SquareWriter<DrapeTexel>::create(drapeFile(folder, levels_.size()), wide);
    if (!writer) return passOn(writer);
    std::vector<DrapeTexel> row(wide);
    for (std::uint32_t j = 0; j < high; j += kSquareSide / 2) {
        ValueWindow<DrapeTexel> window{0, std::int64_t{j} * 2, fine.columns(), kSquareSide, {}};
        if (Result<void> read = fine.read(window); !read) return read;
        for (std::uint32_t y = j; y < std::min(high, j + kSquareSide / 2); ++y) {
            for (std::uint32_t x = 0; x < wide; ++x) {
                unsigned r = 0, g = 0, b = 0, count = 0;
                for (std::uint32_t v = 2 * y; v < std::min(2 * y + 2, fine.rows()); ++v) {
                    for (std::uint32_t u = 2 * x; u < std::min(2 * x + 2, fine.columns()); ++u) {
                        const DrapeTexel& texel = window.at(u, v);
                        r += texel.r, g += texel.g, b += texel.b, ++count;
                    }
                }
                const auto mean = [count](unsigned sum) {
                    return static_cast<std::uint8_t>((sum + count / 2) / count);
                };
                row[x] = {mean(r), mean(g), mean(b)};
            }
            if (Result<void> added = writer->add(row); !added) return added;
        }
    }
    Result<SquareFile<DrapeTexel>> file = writer->finish();
    if (!file) return passOn(file);
    levels_.push_back(std::move(*file));
    return {};
}

Result<Image> TerrainDrape::read(std::uint32_t level, std::int64_t column, std::int64_t row, int width,
                                 int height) const {
    const SquareFile<DrapeTexel>& file = levels_[level];
    const auto clampTo = [](std::int64_t at, std::uint32_t count) {
        return std::clamp<std::int64_t>(at, 0, std::int64_t{count} - 1);
    };
    const std::int64_t left = clampTo(column, file.columns()),
                       right = clampTo(column + width - 1, file.columns());
    const std::int64_t top = clampTo(row, file.rows()), bottom = clampTo(row + height - 1, file.rows());
    ValueWindow<DrapeTexel> window{left,
                                   top,
                                   static_cast<std::uint32_t>(right - left + 1),
                                   static_cast<std::uint32_t>(bottom - top + 1),
                                   {}};
    if (Result<void> read = file.read(window); !read) return passOn(read);
    Image image{width, height, 3, {}, false};
    image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    std::uint8_t* out = image.pixels.data();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, out += 3) {
            std::memcpy(out, &window.at(clampTo(column + x, file.columns()), clampTo(row + y, file.rows())),
                        3);
        }
    }
    return image;
}

}  // namespace fb
