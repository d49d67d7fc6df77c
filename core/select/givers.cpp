#include "select/givers.h"

#include <algorithm>

namespace fb {
namespace {

constexpr double kMostRatio = 1e6;  // also where nothing is lost

}  // namespace

double Givers::find(const RefinementTree& tree, std::uint32_t taker, double overMs, double factor) {
    const Refinement& t = tree.nodes[taker];
    count_ = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const Refinement& r = tree.nodes[i];
        if (!tree.isInnermost(i) || !(r.extraMs > 0.0) || i == t.parent) continue;
        if (r.value * factor < t.value) insert(tree, i);
    }
    double freedMs = 0.0, given = 0.0;
    for (std::size_t g = 0; g < count_; ++g) {
        const Refinement& r = tree.nodes[indices_[g]];
        freedMs += r.extraMs;
        given += r.value * r.extraMs;
        if (freedMs < overMs + t.extraMs) continue;
        count_ = g + 1;
        return given > 0.0 ? std::min(t.value * t.extraMs / given, kMostRatio) : kMostRatio;
    }
    return 0.0;
}

// In the order in which they are given up: the lowest value first, of two equals the lower id.
void Givers::insert(const RefinementTree& tree, std::uint32_t index) {
    const ByValue later{tree, true};
    std::size_t at = count_;
    while (at > 0 && later(indices_[at - 1], index)) --at;
    if (at == kMost) return;
    count_ = std::min(count_ + 1, kMost);
    for (std::size_t g = count_ - 1; g > at; --g) indices_[g] = indices_[g - 1];
    indices_[at] = index;
}

}  // namespace fb
