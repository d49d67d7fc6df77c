// Refinements that may be given up so that another one fits (algorithms 3, step 5): for the policy frontbench.
#pragma once

#include <array>
#include <span>

#include "select/refinement.h"

namespace fb {

class Givers {
  public:
    // The innermost groups of the least value, as few as make room for `taker` (at most 16), each worth less by `factor`.
    // `overMs`: how far the total is above what is wanted already, in the tree's time; below 0 where there is room. Gives how many
    // times as much the taker brings as they do, at most 1e6; 0 where there are none.
    double find(const RefinementTree& tree, std::uint32_t taker, double overMs, double factor);
    [[nodiscard]] std::span<const std::uint32_t> chosen() const { return {indices_.data(), count_}; }

  private:
    static constexpr std::size_t kMost = 16;
    void insert(const RefinementTree& tree, std::uint32_t index);

    std::array<std::uint32_t, kMost> indices_{};
    std::size_t count_ = 0;
};

}  // namespace fb
