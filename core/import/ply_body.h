// The rows of a PLY file behind its header, ascii or binary, value by value. Every count is held against the
// bytes left before it is believed. Comes from read_ply.cpp and goes back there.
#pragma once

#include "import/parse_bytes.h"
#include "import/parse_text.h"
#include "import/ply_header.h"

namespace fb {

// One row of an element, by property: scalars of one value, lists of as many as the file says.
struct PlyRow {
    std::vector<double> scalars;             // 0 where the property is a list
    std::vector<std::vector<double>> lists;  // empty where it is a scalar
};

class PlyBody {
  public:
    PlyBody(const MeshBytes& input, const PlyHeader& header);

    // Refuses a count of rows that the bytes left cannot hold.
    [[nodiscard]] Result<void> checkCount(const PlyElement& element) const;
    [[nodiscard]] Result<void> readRow(const PlyElement& element, PlyRow& row);
    [[nodiscard]] std::size_t bytesLeft() const;
    [[nodiscard]] bool hasMore();             // anything but blanks in an ascii file
    [[nodiscard]] std::string place() const;  // "line 12" or "byte 400"

  private:
    // False at the end of the file or where the text is no number.
    [[nodiscard]] bool next(PlyType type, double& value);
    [[nodiscard]] std::uint64_t leastBytes(PlyType type) const { return isAscii_ ? 2 : sizeOf(type); }
    [[nodiscard]] tl::unexpected<Error> wrong(const PlyElement& element, const PlyProperty& property) const;

    const MeshBytes& input_;
    bool isAscii_, isBigEndian_;
    std::size_t offset_;  // binary
    TextWords words_;     // ascii
    std::uint64_t headerLines_;
};

}  // namespace fb
