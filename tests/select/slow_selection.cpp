#include "select/slow_selection.h"

#include <cmath>

namespace fb {
namespace {

// How far all of the box lies outside the one side of the view that it misses most (item 2).
double slowOutside(const View& view, const Box3f& box) {
    const double up = std::tan(view.camera.fovyRadians / 2.0);
    const double across = up * view.width / view.height;
    double leftOf = INFINITY, rightOf = INFINITY, below = INFINITY, above = INFINITY, before = INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        const glm::dvec3 q = glm::conjugate(view.camera.orientation) * (p - view.camera.eye);
        const double depth = -q.z;
        leftOf = std::min(leftOf, (-q.x - across * depth) / std::sqrt(1.0 + across * across));
        rightOf = std::min(rightOf, (q.x - across * depth) / std::sqrt(1.0 + across * across));
        below = std::min(below, (-q.y - up * depth) / std::sqrt(1.0 + up * up));
        above = std::min(above, (q.y - up * depth) / std::sqrt(1.0 + up * up));
        before = std::min(before, view.camera.nearMetres - depth);
    }
    return std::max({0.0, leftOf, rightOf, below, above, before});
}

double slowDistance(const glm::dvec3& eye, const Box3f& box) {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.min[axis], high = box.max[axis];
        if (eye[axis] < low) squared += (low - eye[axis]) * (low - eye[axis]);
        if (eye[axis] > high) squared += (eye[axis] - high) * (eye[axis] - high);
    }
    return std::sqrt(squared);
}

double slowCost(const SelectInput& in, NodeId n) {
    const double w = in.settings.cTextured;
    return std::max(1.0,
                    in.hierarchy.texturedTriangles[n] * w + in.hierarchy.untexturedTriangles[n] * (1.0 - w));
}

double slowPriority(const SelectInput& in, NodeId n, double outside) {
    const SelectSettings& s = in.settings;
    glm::dvec3 eye = in.view.camera.eye;
    if (in.effects[Effect::velocityLead]) eye += s.lookAhead * in.view.velocity;
    const double d = std::max(s.minDistance, slowDistance(eye, in.hierarchy.bounds[n]));
    double fv = outside > 0.0 ? 0.0 : 1.0;
    if (outside > 0.0 && in.effects[Effect::frustumFalloff])
        fv = std::max(0.0, 1.0 - outside / s.frustumFalloff);
    double fore = 1.0;
    if (in.effects[Effect::foreshortening]) {
        const glm::vec3 a = in.hierarchy.averageNormal[n];
        const glm::dvec3 towardViewer = in.view.camera.orientation * glm::dvec3(0, 0, 1);
        fore = std::max(0.05,
                        1.0 + s.cFore * (towardViewer.x * a.x + towardViewer.y * a.y + towardViewer.z * a.z));
    }
    return in.hierarchy.staticBenefit[n] * (1.0 + s.cVis * fv) * fore / (slowCost(in, n) * d * d);
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

// Item 4; gives cumHyst.
double SlowSelection::moveCounters(const SelectInput& in, const std::vector<Member>& group, double shareMs) {
    const SelectSettings& s = in.settings;
    double all = 0.0, cumHyst = 0.0;
    for (const Member& m : group) all += m.priority;
    for (const Member& m : group) {
        const double slice = shareMs * m.priority / all;
        const double need = in.vTimeMs * slowCost(in, m.node);
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

void SlowSelection::record(const SelectInput& in, NodeId node, bool fine, SlowFrame& frame) {
    fineNow_[node] = fine;
    const auto before = fineBefore_.find(node);
    if (before == fineBefore_.end() || before->second == fine) return;
    ++(fine ? frame.togglesUp : frame.togglesDown);
    const auto last = lastSwitch_.find(node);
    if (last != lastSwitch_.end() && last->second.up != fine && in.frame - last->second.frame <= 35)
        ++frame.pingPongs;
    lastSwitch_[node] = {in.frame, fine};
}

// Item 5.
void SlowSelection::visit(const SelectInput& in, NodeId n, double shareMs, SlowFrame& frame) {
    const Hierarchy& h = in.hierarchy;
    if (h.childCount[n] == 0) return draw(n, BoundBy::leaf, frame);
    const std::vector<Member> group = visibleOf(in, h.firstChild[n], h.childCount[n], frame);
    const auto before = fineBefore_.find(n);
    if (group.empty()) {
        if (before != fineBefore_.end()) fineNow_[n] = before->second;
        return draw(n, BoundBy::leaf, frame);
    }
    double all = 0.0, need = 0.0;
    for (const Member& m : group) {
        all += m.priority;
        need += in.vTimeMs * slowCost(in, m.node);
    }
    bool accepted = false;
    if (in.settings.policy == PolicyId::lakhiaNaive) {
        accepted = shareMs > need;
    } else {
        const double cumHyst = moveCounters(in, group, shareMs);
        accepted = cumHyst >= 0.0;
        if (cumHyst == 0.0 && in.settings.hystBand) accepted = before != fineBefore_.end() && before->second;
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
    record(in, n, accepted && loaded, frame);
    if (!accepted) {
        const bool time = need > shareMs || in.settings.policy == PolicyId::lakhiaNaive;
        return draw(n, time ? BoundBy::time : BoundBy::hysteresis, frame);
    }
    if (!loaded) return draw(n, noRoom ? BoundBy::memory : BoundBy::load, frame);
    for (const Member& m : group) visit(in, m.node, shareMs * m.priority / all, frame);
}

// Items 3 and 6.
SlowFrame SlowSelection::step(const SelectInput& in) {
    SlowFrame frame;
    fineNow_.clear();
    const double share = std::max(in.shareMs, 0.05 * in.targetMs);
    const std::vector<Member> roots = visibleOf(in, 0, in.hierarchy.rootCount, frame);
    double all = 0.0;
    for (const Member& m : roots) all += m.priority;
    if (in.settings.policy == PolicyId::lakhia) moveCounters(in, roots, share);
    for (const Member& m : roots) visit(in, m.node, share * m.priority / all, frame);
    fineBefore_ = fineNow_;
    return frame;
}

}  // namespace fb
