// The two policies of Funkhouser and Sequin, slowly.
#include <algorithm>
#include <cmath>

#include "select/slow_rivals.h"

namespace fb {
namespace {

struct Step {
    NodeId node;
    bool isRoot;
    double value;
};

bool comesFirst(const Step& a, const Step& b) {
    if (a.value != b.value) return a.value > b.value;
    if (a.node != b.node) return a.node < b.node;
    return a.isRoot && !b.isRoot;
}

}  // namespace

double SlowRivals::rootValue(const SlowScene& scene, NodeId root) {
    const double value = std::min(scene[root].benefit / std::max(scene[root].timeMs, 1e-3), 1e300);
    if (reachedBefore_.contains(root)) return value;
    return value * (1.0 - scene.in.settings.switchPenalty);
}

double SlowRivals::refinementValue(const SlowScene& scene, NodeId n) {
    double value = scene[n].value;
    if (!refinedBefore_.contains(n)) value *= 1.0 - scene.in.settings.switchPenalty;
    const NodeId parent = scene.in.hierarchy.parent[n];
    return std::min(value, parent == kNoNode ? rootValue(scene, n) : refinementValue(scene, parent));
}

SlowFrame SlowRivals::funkhouser(SlowScene& scene) {
    std::vector<Step> steps;
    for (NodeId n : scene.roots) steps.push_back({n, true, rootValue(scene, n)});
    for (NodeId n : everythingUsable(scene)) steps.push_back({n, false, refinementValue(scene, n)});
    std::sort(steps.begin(), steps.end(), comesFirst);
    for (std::size_t i = 1; i < steps.size(); ++i) (void)scene.below(steps[i].value, steps[i - 1].value);

    std::vector<NodeId> taken;
    SlowSet refined;
    for (const Step& step : steps) {
        const SlowSet drawn = scene.drawn(taken, refined);
        if (!step.isRoot && !drawn.contains(step.node)) continue;
        const double needMs = step.isRoot ? scene[step.node].timeMs : scene[step.node].extraMs;
        if (scene.below(scene.in.targetMs - scene.totalMs(drawn), needMs)) {
            ++passedOver;
        } else if (step.isRoot) {
            taken.push_back(step.node);
        } else {
            refined.insert(step.node);
        }
    }
    return finish(scene, taken, refined,
                  [&](NodeId n) { return scene[n].usable ? BoundBy::time : scene[n].unusable; });
}

// Until the rest fits; gives what was taken back.
SlowSet SlowRivals::takeBack(SlowScene& scene, SlowSet& refined) {
    SlowSet taken;
    while (scene.below(scene.in.targetMs, scene.totalMs(scene.drawn(scene.roots, refined)))) {
        const NodeId least =
            scene.smallest(scene.innermost(refined), [&](NodeId n) { return scene[n].value; });
        if (least == kNoNode) break;
        refined.erase(least);
        taken.insert(least);
        ++takenBack;
    }
    return taken;
}

SlowFrame SlowRivals::incremental(SlowScene& scene) {
    SlowSet refined, made;
    for (SlowSet left = scene.refinable(scene.roots, refined); !left.empty();) {
        SlowSet kept;
        for (NodeId n : left) {
            if (refinedBefore_.contains(n)) kept.insert(n);
        }
        if (kept.empty()) break;
        refined.merge(kept);
        left = scene.refinable(scene.roots, refined);
    }
    SlowSet takenInThisFrame = takeBack(scene, refined);
    while (true) {
        const SlowSet left = scene.refinable(scene.roots, refined);
        const NodeId best = scene.largest(left, [&](NodeId n) { return scene[n].value; });
        if (best == kNoNode || takenInThisFrame.contains(best)) break;
        refined.insert(best);
        made.insert(best);
        bool undone = false;
        for (NodeId n : takeBack(scene, refined)) {
            takenInThisFrame.insert(n);
            undone = undone || made.contains(n);
        }
        madeAndTakenBack += undone ? 1 : 0;
        if (undone) break;
    }
    return finish(scene, scene.roots, refined,
                  [&](NodeId n) { return scene[n].usable ? BoundBy::time : scene[n].unusable; });
}

}  // namespace fb
