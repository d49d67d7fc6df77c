// Which triangles of a block hang together, and which of those parts a level no longer draws.
#pragma once

#include "build/joiner.h"
#include "prepare_blocks.h"

namespace fb::bench {

struct VanishedParts {
    std::size_t parts = 0, stoodFor = 0, vanished = 0;  // a stand-in is drawn for some; others have nothing left
    std::size_t triangles = 0;                          // of the source, in the vanished ones
};

class Components {
  public:
    explicit Components(const PreparedBlock& block);

    // A number shared by all positions that triangles join.
    [[nodiscard]] std::uint32_t of(std::uint32_t position) const { return ofPosition_[position]; }
    [[nodiscard]] std::size_t sourceTriangles(std::uint32_t component) const { return triangles_[component]; }
    [[nodiscard]] double longestSideMetres(std::uint32_t component) const;
    // By component; of the level that stands for `level`. Stand-ins are of no component.
    [[nodiscard]] std::vector<std::size_t> drawnTriangles(std::size_t level) const;
    [[nodiscard]] bool isStoodFor(std::uint32_t component, std::size_t level) const;
    [[nodiscard]] VanishedParts vanishedAt(std::size_t level) const;

  private:
    const PreparedBlock& block_;
    std::vector<std::uint32_t> ofPosition_;
    std::vector<std::size_t> triangles_;  // by component, of the source before any cut
};

}  // namespace fb::bench
