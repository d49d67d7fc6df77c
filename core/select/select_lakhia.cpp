// Policy `lakhia`: the thesis's selection with time slices and hysteresis counters (thesis 4.2, algorithms section 2).
// Each sibling group gets its parent's slice, shared out by priority. A node's counter grows while its slice exceeds
// the time it needs and falls while it does not; the group is drawn when the truncated counters of its visible members
// add up to 0 or more. The knobs hyst_start, hyst_band and hyst_unit show the printed and the repaired behaviour.
#include <algorithm>
#include <cmath>

#include "select/select_policies.h"
#include "select/sibling_group.h"

namespace fb {
namespace {

struct GroupVote {
    double sumOfCounters = 0.0;  // cumHyst: sum of trunc(h / c_hystSwitch)
    double needMs = 0.0;
};

// h += U * (slice - need) / need, clamped before it is truncated (algorithms 5, case 13).
double movedCounter(const SelectInput& input, double h, double sliceMs, double needMs, SelectCounters& counters) {
    const SelectSettings& s = input.settings;
    h += s.hystUnit * (sliceMs - needMs) / needMs;
    if (!std::isfinite(h)) {
        ++counters.repairedCounters;
        h = s.hystStart * s.hystSwitch;
    }
    return std::clamp(h, -s.hystLimit, s.hystLimit);
}

GroupVote moveCounters(const SelectInput& input, double shareMs, SelectState& state, SelectCounters& counters) {
    GroupVote vote;
    shareOut(input, shareMs, state, counters);
    for (std::size_t i = 0; i < state.group.size(); ++i) {
        const NodeId n = state.group[i];
        const double needMs = timeNeeded(input, n);
        double& h = state.hysteresis[n];
        h = movedCounter(input, h, state.slices[i], needMs, counters);
        vote.sumOfCounters += std::trunc(h / input.settings.hystSwitch);
        vote.needMs += needMs;
    }
    return vote;
}

bool votesForChildren(const SelectInput& input, const SelectState& state, NodeId parent, const GroupVote& vote) {
    if (vote.sumOfCounters != 0.0 || !input.settings.hystBand) return vote.sumOfCounters >= 0.0;
    const bool reachedBefore = state.reachedFrame[parent] + 1 == input.frame;
    return reachedBefore && state.expanded[parent] != 0;
}

Reached decide(const SelectInput& input, NodeId n, double shareMs, SelectState& state, Selection& selection) {
    if (input.hierarchy.isLeaf(n)) return {n, false, BoundBy::leaf};
    gatherGroup(input, n, state, selection);
    if (state.group.empty()) return {n, false, BoundBy::view};
    // Counters move whether or not the group is loaded: loading stays independent of hysteresis.
    const GroupVote vote = moveCounters(input, shareMs, state, selection.counters);
    const GroupMemory memory = groupMemory(input, n, state);
    if (!votesForChildren(input, state, n, vote)) {
        if (memory == GroupMemory::loaded) ++selection.counters.refusedGroups;
        return {n, false, vote.needMs > shareMs ? BoundBy::time : BoundBy::hysteresis, vote.needMs, shareMs};
    }
    if (memory != GroupMemory::loaded) return {n, false, boundByMemory(memory), vote.needMs, shareMs};
    return {n, true, BoundBy::leaf, vote.needMs, shareMs};
}

}  // namespace

void selectLakhia(const SelectInput& input, SelectState& state, Selection& selection) {
    gatherGroup(input, kNoNode, state, selection);
    if (state.group.empty()) return;  // the sky: no counter moves
    // Level 0 is drawn whatever its counters say (algorithms 2 item 6); they move for the panels.
    moveCounters(input, rootShare(input), state, selection.counters);
    descendBySlices(state, selection,
                    [&](NodeId n, double sliceMs) { return decide(input, n, sliceMs, state, selection); });
}

}  // namespace fb
