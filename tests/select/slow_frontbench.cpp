#include "select/slow_frontbench.h"

#include <algorithm>
#include <cmath>

namespace fb {

SlowFrame SlowFrontbench::step(const SelectInput& in) {
    SlowScene scene(in);
    const Camera& camera = in.view.camera;
    if (camera.eye != cameraBefore_.eye || camera.orientation != cameraBefore_.orientation) restSeconds_ = 0.0;
    else restSeconds_ += in.dtSeconds;
    movedMetres_ = glm::distance(camera.eye, cameraBefore_.eye);
    // Of unit quaternions, of which q and -q are the same turn.
    const auto chord = [&](double sign) {
        const glm::dquat d = camera.orientation - sign * cameraBefore_.orientation;
        return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z + d.w * d.w);
    };
    turnedRadians_ = 4.0 * std::asin(std::min(chord(1.0), chord(-1.0)) / 2.0);
    cameraBefore_ = camera;
    patience_ = 1.0;
    if (restSeconds_ >= 4.0) patience_ = in.settings.restFactor;
    else if (restSeconds_ > 2.0) patience_ = 1.0 + (in.settings.restFactor - 1.0) * (restSeconds_ - 2.0) / 2.0;
    if (patience_ > 1.0) ++patientFrames;
    if (scene.roots.empty()) {
        reachedBefore_.clear();
        return scene.finish(scene.roots, {}, switches_, [](NodeId) { return BoundBy::leaf; });
    }
    waits_.clear();
    goOn(scene);
    SlowSet reached = scene.reached(scene.roots, wanted_);
    Limits l = limits(scene);
    if (scene.below(l.limit, totalMs(scene, l))) {
        makeRoom(scene, l);
    } else {
        l.perEstimate = std::max(l.perEstimate, 1.0);  // total is at least now
        improve(scene, l);
    }
    reached.merge(scene.reached(scene.roots, wanted_));
    reachedBefore_ = reached;
    return scene.finish(scene.roots, refinedNow(scene), switches_, [&](NodeId n) {
        if (!scene[n].usable) return scene[n].unusable;
        return waits_.contains(n) ? BoundBy::hysteresis : BoundBy::time;
    });
}

SlowSet SlowFrontbench::refinedNow(const SlowScene& scene) const {
    SlowSet refined;
    for (NodeId n : scene.reached(scene.roots, wanted_)) {
        if (wanted_.contains(n)) refined.insert(n);
    }
    return refined;
}

double SlowFrontbench::totalMs(const SlowScene& scene, const Limits& limits) const {
    return limits.perEstimate * scene.totalMs(scene.drawn(scene.roots, wanted_));
}

// Item 2.
void SlowFrontbench::goOn(SlowScene& scene) {
    std::vector<NodeId> open = scene.roots;
    new_.clear();
    for (std::size_t i = 0; i < open.size(); ++i) {
        const NodeId n = open[i];
        const Box3f& box = scene.in.hierarchy.bounds[n];
        const double away = glm::distance((glm::dvec3(box.min) + glm::dvec3(box.max)) / 2.0, scene.in.view.camera.eye);
        const bool isCut = scene.below(away * (0.3 - turnedRadians_), movedMetres_);
        if (isCut || !reachedBefore_.contains(n)) new_.insert(n);
        if (isCut && reachedBefore_.contains(n)) ++cutNodes;
        if (!scene[n].usable) {
            wanted_.erase(n);
            waited.erase(n);
            if (!scene[n].children.empty()) waited[n] = 1e6f;
        } else if (!reachedBefore_.contains(n)) {
            waited.erase(n);
            if (price > 0.0) {
                const bool fine = scene.below(price * (wanted_.contains(n) ? 0.77 : 1.3), scene[n].value);
                wanted_.erase(n);
                if (fine) wanted_.insert(n);
                if (fine) ++cameAsRefined;
            }
        }
        if (!wanted_.contains(n)) continue;
        open.insert(open.end(), scene[n].children.begin(), scene[n].children.end());
    }
}

// Item 3.
SlowFrontbench::Limits SlowFrontbench::limits(SlowScene& scene) const {
    const SelectSettings& s = scene.in.settings;
    const double target = scene.in.targetMs, noise = s.margin * scene.in.time.residualMs;
    const double now = scene.totalMs(scene.drawn(scene.roots, wanted_));
    double total = now * scene.in.time.slowRatio;
    const auto widened = [&](double mark) { return target + patience_ * (mark - 1.0) * target; };
    const double wide = patience_ * noise;
    if (scene.below(std::max(widened(s.emergencyMark), target + 3.0 * wide), now)) total = std::max(total, now);
    double limit = std::max(target + wide, widened(s.highMark));
    limit = std::min(limit, widened(std::max(1.05, s.highMark)));
    return {total / now, target - wide + 0.75 * noise, limit};
}

SlowSet SlowFrontbench::mayCoarsen(SlowScene& scene) const {
    SlowSet some;
    for (NodeId n : scene.innermost(refinedNow(scene))) {
        if (scene.below(scene[n].timeMs, scene[n].timeMs + scene[n].extraMs)) some.insert(n);
    }
    return some;
}

// Item 4.
void SlowFrontbench::makeRoom(SlowScene& scene, const Limits& l) {
    do {
        const NodeId least = scene.smallest(mayCoarsen(scene), [&](NodeId n) { return scene[n].value; });
        if (least == kNoNode) return;
        wanted_.erase(least);
        price = scene[least].value;
        ++coarsened;
    } while (scene.below(l.mid, totalMs(scene, l)));
}

// Item 5.
void SlowFrontbench::improve(SlowScene& scene, const Limits& l) {
    const SelectSettings& s = scene.in.settings;
    const double dt = scene.in.dtSeconds;
    const double unused = l.mid <= 0.0 ? 0.0 : 1.0 - totalMs(scene, l) / l.mid;
    const double waitSeconds = patience_ * s.refineWait * std::clamp(1.0 - unused / s.urgency, 0.03, 1.0);
    const std::int64_t most = scene.below(s.urgency, unused) ? 4 * s.refineRate : s.refineRate;
    std::int64_t made = 0, tooLarge = 0;
    double largestRefused = 0.0;
    SlowSet notSeen = scene.refinable(scene.roots, wanted_);
    while (!notSeen.empty()) {
        const NodeId n = scene.largest(notSeen, [&](NodeId m) { return scene[m].value; });
        notSeen.erase(n);
        if (!scene.drawn(scene.roots, wanted_).contains(n))
            continue;  // its parent has been given up for another
        const bool free = scene[n].extraMs <= 0.0;
        if (tooLarge >= s.refineRate && !free) continue;
        if (free || !scene.below(l.mid, totalMs(scene, l) + scene[n].extraMs * l.perEstimate)) {
            if (new_.contains(n)) {  // all that comes with it is new, and looked at in this frame
                refine(scene, n);
                ++newRefinements;
                for (NodeId child : scene[n].children) {
                    new_.insert(child);
                    if (!scene[child].usable) continue;
                    waits_.erase(child);
                    notSeen.insert(child);
                }
                continue;
            }
            const double times = price > 0.0 ? sooner(scene, n) * scene[n].value / s.exchangeFactor / price
                                 : scene[n].value > 0.0 ? 1e6 : 1.0;
            if (waited[n] >= 1e6f) ++arrivals;
            waited[n] += static_cast<float>(dt * std::min(1e6, std::max(1.0, times)));
            if (scene.below(double{waited[n]}, waitSeconds) || made >= most) {
                waits_.insert(n);
                continue;
            }
            refine(scene, n);
            ++made;
            ++refinements;
            continue;
        }
        ++tooLarge;
        largestRefused = std::max(largestRefused, scene[n].value);
        const Exchange exchange = exchangeFor(scene, l, n);
        if (exchange.givenUp.empty() || !scene.below(s.exchangeFactor, exchange.ratio)) {
            const double longest = patience_ * s.exchangeWait;
            waited[n] = static_cast<float>(std::max(0.0, std::min(double{waited[n]}, longest) - dt));
            continue;
        }
        waited[n] = static_cast<float>(double{waited[n]} + dt * sooner(scene, n) * exchange.ratio / s.exchangeFactor);
        ++exchangesAwaited;
        if (!new_.contains(n) && scene.below(double{waited[n]}, patience_ * s.exchangeWait)) {
            waits_.insert(n);
            continue;
        }
        for (NodeId other : exchange.givenUp) wanted_.erase(other);
        refine(scene, n);
        ++exchanges;
        if (new_.contains(n)) ++newExchanges;
        if (exchange.givenUp.size() > 1) ++exchangesOfSeveral;
    }
    price = std::max(largestRefused, price / (1.0 + dt));
}

double SlowFrontbench::sooner(const SlowScene& scene, NodeId n) {
    const double limit = scene.in.settings.waitPixels;
    return scene[n].errorPixels > limit ? scene[n].errorPixels / limit : 1.0;
}

// What makes room for the node, and how many times as much the node brings.
SlowFrontbench::Exchange SlowFrontbench::exchangeFor(SlowScene& scene, const Limits& l, NodeId n) const {
    SlowSet candidates;
    for (NodeId j : mayCoarsen(scene)) {
        if (j == scene.in.hierarchy.parent[n]) continue;
        if (scene.below(scene[j].value * scene.in.settings.exchangeFactor, scene[n].value))
            candidates.insert(j);
    }
    Exchange exchange;
    double wouldBe = totalMs(scene, l) + scene[n].extraMs * l.perEstimate, lost = 0.0;
    while (exchange.givenUp.size() < 16 && scene.below(l.mid, wouldBe)) {
        const NodeId least = scene.smallest(candidates, [&](NodeId m) { return scene[m].value; });
        if (least == kNoNode) return {};
        candidates.erase(least);
        exchange.givenUp.insert(least);
        wouldBe -= scene[least].extraMs * l.perEstimate;
        lost += scene[least].value * scene[least].extraMs;
    }
    if (scene.below(l.mid, wouldBe)) return {};
    exchange.ratio = std::min(1e6, scene[n].value * scene[n].extraMs / lost);
    return exchange;
}

void SlowFrontbench::refine(const SlowScene& scene, NodeId n) {
    wanted_.insert(n);
    waited.erase(n);
    for (NodeId child : scene[n].children) {
        wanted_.erase(child);
        waited.erase(child);
        waits_.insert(child);
    }
}

}  // namespace fb
