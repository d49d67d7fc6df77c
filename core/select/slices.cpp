#include "select/slices.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

// Of the time of all leaves below: exactly as much would leave counters where they are, and what fits refused.
constexpr double kCapFactor = 1.25;
constexpr int kHalvings = 60;

// Triangles of all leaves below each node, once a scene: children stand after their parents.
void sumLeaves(const Hierarchy& h, LeavesBelow& leaves) {
    leaves.textured.assign(h.size(), 0.0);
    leaves.untextured.assign(h.size(), 0.0);
    leaves.count.assign(h.size(), 0.0);
    for (NodeId n = h.size(); n-- > 0;) {
        if (h.isLeaf(n)) {
            leaves.textured[n] = h.texturedTriangles[n];
            leaves.untextured[n] = h.untexturedTriangles[n];
            leaves.count[n] = 1.0;
        }
        if (h.parent[n] == kNoNode) continue;
        leaves.textured[h.parent[n]] += leaves.textured[n];
        leaves.untextured[h.parent[n]] += leaves.untextured[n];
        leaves.count[h.parent[n]] += leaves.count[n];
    }
}

double leavesMs(const TimeModel& time, const LeavesBelow& leaves, NodeId n) {
    return time.texturedMs * leaves.textured[n] + time.untexturedMs * leaves.untextured[n] + time.nodeMs * leaves.count[n];
}


// With the need and the cap of each in state.slices, one after the other.
double sumAt(double lambda, const SelectState& state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.group.size(); ++i)
        sum += std::clamp(lambda * state.priorities[i], state.slices[2 * i], state.slices[2 * i + 1]);
    return sum;
}

void redistribute(const SelectInput& input, double shareMs, SelectState& state) {
    if (state.leaves.count.size() != input.hierarchy.size()) sumLeaves(input.hierarchy, state.leaves);
    std::vector<double>& into = state.slices;
    const std::size_t count = state.group.size();
    double needs = 0.0, most = 0.0;
    for (const NodeId n : state.group) {
        const double need = nodeTimeMs(input.time, input.hierarchy, n);
        const double cap = std::max(need, kCapFactor * leavesMs(input.time, state.leaves, n));
        into.push_back(need);
        into.push_back(cap);
        needs += need;
        most += cap;
    }
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < count; ++i) high = std::max(high, into[2 * i + 1] / state.priorities[i]);
    if (needs < shareMs && shareMs < most) {
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (sumAt(middle, state) < shareMs ? low : high) = middle;
        }
    }
    // Between the last two lambdas the sum is as good as linear.
    const double atLow = sumAt(low, state), atHigh = sumAt(high, state);
    const double part = atHigh > atLow ? (shareMs - atLow) / (atHigh - atLow) : 1.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double need = into[2 * i], cap = into[2 * i + 1];
        const double lower = std::clamp(low * state.priorities[i], need, cap);
        const double upper = std::clamp(high * state.priorities[i], need, cap);
        into[i] = needs >= shareMs ? shareMs * need / needs
                          : most <= shareMs ? shareMs * cap / most
                                            : std::lerp(lower, upper, part);
    }
    into.resize(count);
}

}  // namespace

void shareOut(const SelectInput& input, double shareMs, SelectState& state, SelectCounters& counters) {
    state.slices.clear();
    if (input.effects[Effect::redistribution]) {
        counters.effectWork[Effect::redistribution] += state.group.size();
        redistribute(input, shareMs, state);
        return;
    }
    double sum = 0.0;
    for (const double priority : state.priorities) sum += priority;
    for (const double priority : state.priorities) state.slices.push_back(shareMs / sum * priority);
}

}  // namespace fb
