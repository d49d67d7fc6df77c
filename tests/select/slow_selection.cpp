#include "select/slow_selection.h"

#include <algorithm>
#include <cmath>

#include "select/slow_look.h"

namespace fb {
namespace {

// v_time is what the least node takes.
double slowNeed(const SelectInput& in, NodeId n) {
    return in.time.leastMs * slowCost(in, n);
}

}  // namespace

std::vector<SlowSelection::Member> SlowSelection::visibleOf(const SelectInput& in, NodeId first,
                                                            std::uint32_t count, SlowFrame& frame) {
    std::vector<Member> group;
    for (NodeId n = first; n < first + count; ++n) {
        const double outside = slowOutside(in.view, in.hierarchy.bounds[n]);
        if (outside > 0.0) continue;
        double p = slowPriority(in, n, outside);
        if (!std::isfinite(p) || p <= 0.0) {
            p = 1e-12;
            ++frame.repairedPriorities;
        }
        group.push_back({n, p});
    }
    return group;
}

namespace {

double slowLeavesNeed(const SelectInput& in, NodeId n) {
    const Hierarchy& h = in.hierarchy;
    const double w = in.settings.cTextured;
    if (h.childCount[n] == 0)
        return in.time.leastMs * (h.texturedTriangles[n] * w + h.untexturedTriangles[n] * (1.0 - w));
    double sum = 0.0;
    for (std::uint32_t i = 0; i < h.childCount[n]; ++i) sum += slowLeavesNeed(in, h.firstChild[n] + i);
    return sum;
}

}  // namespace

// Thesis eq. 4.1, or 3.1 Redistribution: all lambdas at which a slice begins or ends to grow are tried one after the other.
std::vector<double> SlowSelection::slicesOf(const SelectInput& in, const std::vector<Member>& group, double shareMs) {
    std::vector<double> slices, needs, caps, lambdas = {0.0};
    if (group.empty()) return slices;
    double all = 0.0, needed = 0.0, usable = 0.0;
    for (const Member& m : group) {
        all += m.priority;
        needs.push_back(slowNeed(in, m.node));
        caps.push_back(std::max(needs.back(), 1.25 * slowLeavesNeed(in, m.node)));
        needed += needs.back();
        usable += caps.back();
        lambdas.push_back(needs.back() / m.priority);
        lambdas.push_back(caps.back() / m.priority);
    }
    const auto sliceAt = [&](std::size_t i, double lambda) {
        return std::max(needs[i], std::min(caps[i], lambda * group[i].priority));
    };
    const auto sumAt = [&](double lambda) {
        double sum = 0.0;
        for (std::size_t i = 0; i < group.size(); ++i) sum += sliceAt(i, lambda);
        return sum;
    };
    std::sort(lambdas.begin(), lambdas.end());
    std::size_t above = 1;
    while (above + 1 < lambdas.size() && sumAt(lambdas[above]) < shareMs) ++above;
    const double low = lambdas[above - 1], high = lambdas[above];
    const double rise = sumAt(high) - sumAt(low);
    const double lambda = rise > 0.0 ? low + (high - low) * (shareMs - sumAt(low)) / rise : high;
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (!in.effects[Effect::redistribution]) slices.push_back(shareMs * group[i].priority / all);
        else if (needed >= shareMs) slices.push_back(shareMs * needs[i] / needed);
        else if (usable <= shareMs) slices.push_back(shareMs * caps[i] / usable);
        else slices.push_back(sliceAt(i, lambda));
    }
    return slices;
}

// Item 4; gives cumHyst.
double SlowSelection::moveCounters(const SelectInput& in, const std::vector<Member>& group, double shareMs) {
    const SelectSettings& s = in.settings;
    double cumHyst = 0.0;
    const std::vector<double> slices = slicesOf(in, group, shareMs);
    for (std::size_t i = 0; i < group.size(); ++i) {
        const Member& m = group[i];
        const double slice = slices[i];
        const double need = slowNeed(in, m.node);
        const auto [at, isNew] = counters.try_emplace(m.node, s.hystStart * s.hystSwitch);
        double& h = at->second;
        h += s.hystUnit * (slice - need) / need;
        if (h > s.hystLimit) h = s.hystLimit;
        if (h < -s.hystLimit) h = -s.hystLimit;
        cumHyst += static_cast<double>(static_cast<long long>(h / s.hystSwitch));  // toward zero
    }
    return cumHyst;
}

void SlowSelection::draw(NodeId node, BoundBy reason, SlowFrame& frame) {
    frame.front.insert(node);
    frame.boundBy[node] = reason;
}

// Item 5.
void SlowSelection::visit(const SelectInput& in, NodeId n, double shareMs, SlowFrame& frame) {
    const Hierarchy& h = in.hierarchy;
    if (h.childCount[n] == 0) return draw(n, BoundBy::leaf, frame);
    const std::vector<Member> group = visibleOf(in, h.firstChild[n], h.childCount[n], frame);
    if (group.empty()) {
        switches_.keep(n);
        return draw(n, BoundBy::view, frame);
    }
    double need = 0.0;
    for (const Member& m : group) need += slowNeed(in, m.node);
    bool accepted = false;
    if (in.settings.policy == PolicyId::lakhiaNaive) {
        accepted = shareMs > need;
    } else {
        const double cumHyst = moveCounters(in, group, shareMs);
        accepted = cumHyst >= 0.0;
        if (cumHyst == 0.0 && in.settings.hystBand) accepted = switches_.wasFine(n);
    }
    std::set<NodeId> needed;
    for (const Member& m : group) needed.insert(m.node);
    if (in.settings.needAllChildren) {
        for (std::uint32_t i = 0; i < h.childCount[n]; ++i) needed.insert(h.firstChild[n] + i);
    }
    bool loaded = true, noRoom = false;
    for (NodeId child : needed) {
        if (in.loaded[child] == 0) loaded = false;
        if (in.memoryRefused[child] != 0) noRoom = true;
    }
    if (loaded && !accepted) ++frame.refusedGroups;
    switches_.record(in.frame, n, accepted && loaded, frame);
    if (!accepted) {
        const bool time = need > shareMs || in.settings.policy == PolicyId::lakhiaNaive;
        return draw(n, time ? BoundBy::time : BoundBy::hysteresis, frame);
    }
    if (!loaded) return draw(n, noRoom ? BoundBy::memory : BoundBy::load, frame);
    const std::vector<double> slices = slicesOf(in, group, shareMs);
    for (std::size_t i = 0; i < group.size(); ++i) visit(in, group[i].node, slices[i], frame);
}

// Items 3 and 6.
SlowFrame SlowSelection::step(const SelectInput& in) {
    SlowFrame frame;
    const double share = std::max(in.shareMs, 0.05 * in.targetMs);
    const std::vector<Member> roots = visibleOf(in, 0, in.hierarchy.rootCount, frame);
    if (in.settings.policy == PolicyId::lakhia) moveCounters(in, roots, share);
    const std::vector<double> slices = slicesOf(in, roots, share);
    for (std::size_t i = 0; i < roots.size(); ++i) visit(in, roots[i].node, slices[i], frame);
    switches_.endFrame();
    return frame;
}

}  // namespace fb
