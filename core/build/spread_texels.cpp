#include "build/spread_texels.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace fb {
namespace {

const TileMask kNothing{};

// Where a ring's texels come from: the texel this far away.
constexpr glm::ivec2 kByEdge[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
constexpr glm::ivec2 kByCorner[] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};

// Where the texels of a picture's tiles are.
struct TexelPlaces {
    const TiledPicture& shape;
    std::vector<std::uint8_t*> corners;  // by tile
    std::size_t rowBytes = 0;

    [[nodiscard]] std::uint8_t* texel(std::uint32_t tile, int x, int y) const {
        return corners[tile] + static_cast<std::size_t>(y) * rowBytes +
               static_cast<std::size_t>(x) * static_cast<std::size_t>(shape.channels);
    }
};

// A tile whose texels are not all known, with the masks of the tiles around it: [row + 1][column + 1].
struct GrowingTile {
    std::uint32_t tile = 0;
    TileMask inside;
    std::array<std::array<const TileMask*, 3>, 3> around;
    std::array<std::array<std::uint32_t, 3>, 3> tiles;
    TileMask fresh;
};

class RingGrower {
  public:
    RingGrower(const TexelPlaces& places, std::span<TileMask> known, int firstChannel, int endChannel)
        : places_(places), known_(known), first_(firstChannel), end_(endChannel) {}

    void run(std::vector<GrowingTile>& growing) {
        for (int ring = 0; ring < kCopiedRings && !growing.empty(); ++ring) {
            // Every tile sees its neighbours as they were before the ring, whatever the order.
            for (GrowingTile& tile : growing) grow(tile, ring % 2 == 0);
            for (const GrowingTile& tile : growing) {
                for (std::size_t y = 0; y < kTileSide; ++y) known_[tile.tile].rows[y] |= tile.fresh.rows[y];
            }
        }
    }

  private:
    // Bit x of the result: is the texel at (x + dx, y) known?
    static std::uint64_t knownBeside(const GrowingTile& tile, int y, int dx) {
        const auto row = static_cast<std::size_t>(1 + (y >= kTileSide) - (y < 0));
        const auto line = static_cast<std::size_t>((y + kTileSide) % kTileSide);
        const auto& masks = tile.around[row];
        const std::uint64_t here = masks[1]->rows[line];
        if (dx < 0) return here << 1 | masks[0]->rows[line] >> (kTileSide - 1);
        if (dx > 0) return here >> 1 | masks[2]->rows[line] << (kTileSide - 1);
        return here;
    }

    void grow(GrowingTile& tile, bool byEdge) {
        for (int y = 0; y < kTileSide; ++y) {
            const auto line = static_cast<std::size_t>(y);
            std::uint64_t missing = tile.inside.rows[line] & ~known_[tile.tile].rows[line];
            std::uint64_t& fresh = tile.fresh.rows[line];
            fresh = 0;
            if (missing == 0) continue;
            for (const glm::ivec2& from : byEdge ? kByEdge : kByCorner) {
                const std::uint64_t reached = missing & knownBeside(tile, y + from.y, from.x);
                for (std::uint64_t rest = reached; rest != 0;) {
                    const int begin = std::countr_zero(rest), count = std::countr_one(rest >> begin);
                    copyRun(tile, {begin, y}, count, from);
                    rest &= count == kTileSide ? 0 : ~(((std::uint64_t{1} << count) - 1) << begin);
                }
                fresh |= reached;
                missing &= ~reached;
            }
        }
    }

    // Texels beside each other come from one row: those of one column from the column before have gaps.
    void copyRun(const GrowingTile& tile, const glm::ivec2& at, int count, const glm::ivec2& from) const {
        const glm::ivec2 source = at + from;
        const bool oneTile = source.x >= 0 && source.y >= 0 && source.x + count <= kTileSide && source.y < kTileSide;
        if (oneTile && first_ == 0 && end_ == places_.shape.channels) {
            std::memmove(places_.texel(tile.tile, at.x, at.y), places_.texel(tile.tile, source.x, source.y),
                         static_cast<std::size_t>(count) * static_cast<std::size_t>(end_));
            return;
        }
        for (int i = 0; i < count; ++i) copyTexel(tile, at + glm::ivec2(i, 0), source + glm::ivec2(i, 0));
    }

    void copyTexel(const GrowingTile& tile, const glm::ivec2& at, const glm::ivec2& source) const {
        const auto column = static_cast<std::size_t>(1 + (source.x >= kTileSide) - (source.x < 0));
        const auto row = static_cast<std::size_t>(1 + (source.y >= kTileSide) - (source.y < 0));
        const std::uint8_t* const texel = places_.texel(tile.tiles[row][column], (source.x + kTileSide) % kTileSide,
                                                        (source.y + kTileSide) % kTileSide);
        std::uint8_t* const target = places_.texel(tile.tile, at.x, at.y);
        for (int c = first_; c < end_; ++c) target[c] = texel[c];
    }

    const TexelPlaces& places_;
    std::span<TileMask> known_;
    int first_, end_;
};

// The mean colour of a square, if it has known texels.
struct Cell {
    std::array<std::uint8_t, 4> colour{};
    bool known = false;
};

Cell meanOf(std::span<const Cell> cells) {
    std::array<unsigned, 4> sums{};
    unsigned count = 0;
    for (const Cell& cell : cells) {
        if (!cell.known) continue;
        for (std::size_t c = 0; c < 4; ++c) sums[c] += cell.colour[c];
        ++count;
    }
    Cell mean;
    if (count == 0) return mean;
    for (std::size_t c = 0; c < 4; ++c) mean.colour[c] = static_cast<std::uint8_t>((sums[c] + count / 2) / count);
    mean.known = true;
    return mean;
}

// Gives unknown cells the mean of the smallest square around them that is known, and returns the mean of all.
Cell fillCells(std::vector<Cell>& cells, int width, int height) {
    if (width == 1 && height == 1) return cells[0];
    const int halfWidth = (width + 1) / 2, halfHeight = (height + 1) / 2;
    const auto at = [](int x, int y, int across) { return static_cast<std::size_t>(y * across + x); };
    std::vector<Cell> half(static_cast<std::size_t>(halfWidth) * static_cast<std::size_t>(halfHeight));
    for (int y = 0; y < halfHeight; ++y) {
        for (int x = 0; x < halfWidth; ++x) {
            std::array<Cell, 4> four;
            for (int k = 0; k < 4; ++k) {
                const int fx = 2 * x + k % 2, fy = 2 * y + k / 2;
                if (fx < width && fy < height) four[static_cast<std::size_t>(k)] = cells[at(fx, fy, width)];
            }
            half[at(x, y, halfWidth)] = meanOf(four);
        }
    }
    const Cell mean = fillCells(half, halfWidth, halfHeight);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Cell& cell = cells[at(x, y, width)];
            if (!cell.known) cell = half[at(x / 2, y / 2, halfWidth)];
        }
    }
    return mean;
}

class FarFiller {
  public:
    FarFiller(const TexelPlaces& places, std::span<const TileMask> known, int firstChannel, int endChannel)
        : places_(places), known_(known), first_(firstChannel), end_(endChannel) {}

    // What the rings did not reach. `growing` are the tiles that were not whole before.
    void run(const std::vector<GrowingTile>& growing) {
        std::vector<const GrowingTile*> empty;
        for (const GrowingTile& tile : growing) {
            if (known_[tile.tile].rows == tile.inside.rows) continue;
            std::vector<Cell> cells = cellsOf(tile.tile);
            if (fillCells(cells, kCells, kCells).known) {
                paint(tile, cells);
            } else {
                empty.push_back(&tile);
            }
        }
        if (!empty.empty()) paintEmpty(empty);
    }

  private:
    static constexpr int kCellSide = 8;  // texels; as the blocks of JPEG
    static constexpr int kCells = kTileSide / kCellSide;  // a side

    struct Sum {
        std::array<unsigned, 4> colour{};
        unsigned count = 0;
    };

    [[nodiscard]] std::vector<Cell> cellsOf(std::uint32_t tile) const {
        std::array<Sum, static_cast<std::size_t>(kCells) * kCells> sums;
        for (int y = 0; y < kTileSide; ++y) {
            const std::uint64_t row = known_[tile].rows[static_cast<std::size_t>(y)];
            if (row == 0) continue;
            for (int column = 0; column < kCells; ++column) {
                const auto mask = static_cast<std::uint8_t>(row >> (column * kCellSide));
                if (mask == 0) continue;
                addRow(places_.texel(tile, column * kCellSide, y), mask,
                       sums[static_cast<std::size_t>(y / kCellSide * kCells + column)]);
            }
        }
        std::vector<Cell> cells(sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const Sum& sum = sums[i];
            if (sum.count == 0) continue;
            cells[i].known = true;
            for (std::size_t c = 0; c < 4; ++c)
                cells[i].colour[c] = static_cast<std::uint8_t>((sum.colour[c] + sum.count / 2) / sum.count);
        }
        return cells;
    }

    // A row of a cell, of which the bits in `mask` are known.
    void addRow(const std::uint8_t* texels, std::uint8_t mask, Sum& sum) const {
        const int channels = places_.shape.channels;
        const auto add = [&](int count) {
            for (int c = first_; c < end_; ++c) sum.colour[static_cast<std::size_t>(c)] += texels[count * channels + c];
        };
        sum.count += static_cast<unsigned>(std::popcount(mask));
        if (mask == 0xFF) {
            for (int x = 0; x < kCellSide; ++x) add(x);
            return;
        }
        for (unsigned rest = mask; rest != 0; rest &= rest - 1) add(std::countr_zero(rest));
    }

    void paint(const GrowingTile& tile, std::span<const Cell> cells) const {
        for (int y = 0; y < kTileSide; ++y) {
            const auto line = static_cast<std::size_t>(y);
            for (std::uint64_t rest = tile.inside.rows[line] & ~known_[tile.tile].rows[line]; rest != 0;
                 rest &= rest - 1) {
                const int x = std::countr_zero(rest);
                const Cell& cell = cells[static_cast<std::size_t>(y / kCellSide * kCells + x / kCellSide)];
                std::uint8_t* const texel = places_.texel(tile.tile, x, y);
                for (int c = first_; c < end_; ++c) texel[c] = cell.colour[static_cast<std::size_t>(c)];
            }
        }
    }

    // Tiles without any known texel: from the means of the others.
    void paintEmpty(std::span<const GrowingTile* const> empty) const {
        const TiledPicture& shape = places_.shape;
        std::vector<Cell> means(shape.tiles.size());
        for (std::size_t i = 0; i < means.size(); ++i) {
            if (shape.tiles[i] == kNoTile) continue;
            std::vector<Cell> cells = cellsOf(shape.tiles[i]);
            means[i] = fillCells(cells, kCells, kCells);
        }
        fillCells(means, shape.columns, shape.rows);
        for (const GrowingTile* const tile : empty) {
            const glm::ivec2 place = shape.places[tile->tile];
            const std::size_t at = static_cast<std::size_t>(place.y) * static_cast<std::size_t>(shape.columns) +
                                   static_cast<std::size_t>(place.x);
            paint(*tile, std::vector<Cell>(static_cast<std::size_t>(kCells) * kCells, means[at]));
        }
    }

    const TexelPlaces& places_;
    std::span<const TileMask> known_;
    int first_, end_;
};

std::vector<GrowingTile> findGrowing(const TiledPicture& shape, std::span<const TileMask> known) {
    std::vector<GrowingTile> growing;
    for (std::uint32_t i = 0; i < known.size(); ++i) {
        const TileMask inside = shape.insideMask(i);
        if (known[i].rows == inside.rows) continue;
        GrowingTile& tile = growing.emplace_back();
        tile.tile = i;
        tile.inside = inside;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                const glm::ivec2 place = shape.places[i] + glm::ivec2(column - 1, row - 1);
                const std::uint32_t neighbour = shape.tileOrNone(place.x, place.y);
                tile.tiles[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = neighbour;
                tile.around[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                    neighbour == kNoTile ? &kNothing : &known[neighbour];
            }
        }
    }
    return growing;
}

void spread(const TexelPlaces& places, std::span<TileMask> known, int firstChannel, int endChannel) {
    std::vector<GrowingTile> growing = findGrowing(places.shape, known);
    if (growing.empty() || std::none_of(known.begin(), known.end(), [](const TileMask& m) { return m.any(); }))
        return;
    RingGrower(places, known, firstChannel, endChannel).run(growing);
    FarFiller(places, known, firstChannel, endChannel).run(growing);
}

// Bit i of the result: is bytes[i] 1? For up to 8 bytes that are 0 or 1.
std::uint64_t packBits(const std::uint8_t* bytes, int count) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, static_cast<std::size_t>(count));
    static_assert(std::endian::native == std::endian::little);
    return (word * 0x0102040810204080ull) >> 56;
}

}  // namespace

void spreadTexels(TiledPicture& picture, std::span<TileMask> known, int firstChannel, int endChannel) {
    TexelPlaces places{picture, {}, static_cast<std::size_t>(kTileSide * picture.channels)};
    for (std::size_t i = 0; i < picture.places.size(); ++i)
        places.corners.push_back(picture.texels.data() + i * picture.tileBytes());
    spread(places, known, firstChannel, endChannel);
}

void fillUnknown(Image& image, const std::vector<std::uint8_t>& known, int firstChannel, int endChannel) {
    TiledPicture shape = TiledPicture::ofSize(image.width, image.height, image.channels);
    const auto channels = static_cast<std::size_t>(image.channels);
    TexelPlaces places{shape, {}, static_cast<std::size_t>(image.width) * channels};
    std::vector<TileMask> masks;
    for (int row = 0; row < shape.rows; ++row) {
        for (int column = 0; column < shape.columns; ++column) {
            shape.addTile(column, row);
            const int left = column * kTileSide, top = row * kTileSide;
            const int width = std::min(kTileSide, image.width - left);
            places.corners.push_back(image.pixels.data() + static_cast<std::size_t>(top) * places.rowBytes +
                                     static_cast<std::size_t>(left) * channels);
            TileMask& mask = masks.emplace_back();
            for (int y = 0; y < std::min(kTileSide, image.height - top); ++y) {
                const std::uint8_t* const line = known.data() +
                                                 static_cast<std::size_t>(top + y) *
                                                     static_cast<std::size_t>(image.width) +
                                                 static_cast<std::size_t>(left);
                for (int x = 0; x < width; x += 8) {
                    mask.rows[static_cast<std::size_t>(y)] |= packBits(line + x, std::min(8, width - x)) << x;
                }
            }
        }
    }
    spread(places, masks, firstChannel, endChannel);
}

}  // namespace fb
