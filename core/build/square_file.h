// A large grid of small values (heights, texels) on disk, in squares of 64 x 64, so that a window anywhere in
// it is read without reading whole rows. Written once, row by row; read from any thread. A work file of
// terrain builds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <type_traits>
#include <vector>

#include "base/file_io.h"

namespace fb {

inline constexpr std::uint32_t kSquareSide = 64;

[[nodiscard]] constexpr std::uint32_t squaresAcross(std::uint32_t values) {
    return (values + kSquareSide - 1) / kSquareSide;
}

// Values [column, column + columns) x [row, row + rows).
template <class T>
struct ValueWindow {
    std::int64_t column = 0, row = 0;
    std::uint32_t columns = 0, rows = 0;
    std::vector<T> values;

    [[nodiscard]] const T& at(std::int64_t c, std::int64_t r) const {
        return values[static_cast<std::size_t>(r - row) * columns + static_cast<std::size_t>(c - column)];
    }
};

template <class T>
class SquareFile {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    [[nodiscard]] static Result<SquareFile> open(const std::filesystem::path& path, std::uint32_t columns,
                                                 std::uint32_t rows) {
        Result<FileReader> file = FileReader::open(path);
        if (!file) return passOn(file);
        SquareFile opened;
        opened.file_ = std::move(*file);
        opened.columns_ = columns;
        opened.rows_ = rows;
        return opened;
    }
    [[nodiscard]] std::uint32_t columns() const { return columns_; }
    [[nodiscard]] std::uint32_t rows() const { return rows_; }

    // T{} beyond the grid.
    [[nodiscard]] Result<void> read(ValueWindow<T>& window) const {
        window.values.assign(std::size_t{window.columns} * window.rows, T{});
        const std::int64_t left = std::max<std::int64_t>(window.column, 0),
                           top = std::max<std::int64_t>(window.row, 0);
        const std::int64_t right = std::min<std::int64_t>(window.column + window.columns, columns_);
        const std::int64_t bottom = std::min<std::int64_t>(window.row + window.rows, rows_);
        if (left >= right || top >= bottom) return {};
        const std::int64_t first = left / kSquareSide, end = (right - 1) / kSquareSide + 1;
        std::vector<T> band(static_cast<std::size_t>(end - first) * kSquareSide * kSquareSide);
        for (std::int64_t squareRow = top / kSquareSide; squareRow * kSquareSide < bottom; ++squareRow) {
            const auto square = static_cast<std::uint64_t>(squareRow * squaresAcross(columns_) + first);
            if (Result<void> read =
                    file_.readAt(square * kSquareSide * kSquareSide * sizeof(T),
                                 {reinterpret_cast<std::uint8_t*>(band.data()), band.size() * sizeof(T)});
                !read) {
                return read;
            }
            const std::int64_t endRow = std::min(bottom, (squareRow + 1) * kSquareSide);
            for (std::int64_t y = std::max(top, squareRow * kSquareSide); y < endRow; ++y) {
                copyRow(band, y, {left, right, first}, window);
            }
        }
        return {};
    }

  private:
    struct Span {
        std::int64_t left, right, firstSquare;
    };
    static void copyRow(const std::vector<T>& band, std::int64_t y, const Span& span,
                        ValueWindow<T>& window) {
        for (std::int64_t x = span.left; x < span.right;) {
            const std::int64_t square = x / kSquareSide,
                               end = std::min(span.right, (square + 1) * kSquareSide);
            const std::int64_t from =
                ((square - span.firstSquare) * kSquareSide + y % kSquareSide) * kSquareSide + x % kSquareSide;
            std::copy_n(band.begin() + from, end - x,
                        window.values.begin() + (y - window.row) * window.columns + (x - window.column));
            x = end;
        }
    }

    FileReader file_;
    std::uint32_t columns_ = 0, rows_ = 0;
};

template <class T>
class SquareWriter {
  public:
    [[nodiscard]] static Result<SquareWriter> create(const std::filesystem::path& path,
                                                     std::uint32_t columns) {
        Result<AtomicFile> file = AtomicFile::create(path);
        if (!file) return passOn(file);
        SquareWriter writer;
        writer.file_ = std::move(*file);
        writer.path_ = path;
        writer.columns_ = columns;
        writer.band_.resize(std::size_t{squaresAcross(columns)} * kSquareSide * kSquareSide);
        return writer;
    }
    [[nodiscard]] Result<void> add(std::span<const T> row) {
        for (std::uint32_t i = 0; i < columns_; ++i) {
            band_[(std::size_t{i / kSquareSide} * kSquareSide + filled_) * kSquareSide + i % kSquareSide] =
                row[i];
        }
        ++rows_;
        return ++filled_ == kSquareSide ? flush() : Result<void>();
    }
    [[nodiscard]] Result<SquareFile<T>> finish() {
        if (filled_ > 0) {
            if (Result<void> written = flush(); !written) return passOn(written);
        }
        if (Result<void> finished = file_.finish(); !finished) return passOn(finished);
        return SquareFile<T>::open(path_, columns_, rows_);
    }

  private:
    Result<void> flush() {
        Result<void> written =
            file_.write({reinterpret_cast<const std::uint8_t*>(band_.data()), band_.size() * sizeof(T)});
        std::fill(band_.begin(), band_.end(), T{});
        filled_ = 0;
        return written;
    }

    AtomicFile file_;
    std::filesystem::path path_;
    std::uint32_t columns_ = 0, rows_ = 0, filled_ = 0;
    std::vector<T> band_;
};

}  // namespace fb
