#include "select/slow_rivals.h"

namespace fb {

SlowFrame SlowRivals::step(const SelectInput& in) {
    SlowScene scene(in);
    switch (in.settings.policy) {
        case PolicyId::greedy:
            return greedy(scene);
        case PolicyId::funkhouser:
            return funkhouser(scene);
        case PolicyId::funkhouserIncremental:
            return incremental(scene);
        case PolicyId::macielShirley:
            return macielShirley(scene);
        case PolicyId::erikson:
            return erikson(scene);
        case PolicyId::screenError:
            return screenError(scene);
        case PolicyId::coarse:
            return coarse(scene);
        default:
            return full(scene);
    }
}

SlowSet SlowRivals::greedyWish(SlowScene& scene) {
    SlowSet refined, passedOver;
    while (true) {
        SlowSet left = scene.refinable(scene.roots, refined);
        for (NodeId n : passedOver) left.erase(n);
        const NodeId best = scene.largest(left, [&](NodeId n) { return scene[n].value; });
        if (best == kNoNode) return refined;
        const double total = scene.totalMs(scene.drawn(scene.roots, refined));
        const bool tooMuch = scene.below(scene.in.targetMs, total + scene[best].extraMs);
        (tooMuch ? passedOver : refined).insert(best);
    }
}

SlowFrame SlowRivals::greedy(SlowScene& scene) {
    return finish(scene, scene.roots, greedyWish(scene),
                  [&](NodeId n) { return scene[n].usable ? BoundBy::time : scene[n].unusable; });
}

SlowFrame SlowRivals::macielShirley(SlowScene& scene) {
    const SlowSet wish = greedyWish(scene);
    SlowSet refined, reached, justRefined;
    std::vector<NodeId> open = scene.roots;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const NodeId n = open[i], parent = scene.in.hierarchy.parent[n];
        const bool wished = wish.contains(n);
        bool fine = reachedBefore_.contains(n) && refinedBefore_.contains(n);
        if (!scene[n].usable) {
            fine = false;
            counted.erase(n);
        } else if (parent != kNoNode && justRefined.contains(parent)) {
            fine = false;
            counted.erase(n);
        } else if (!reachedBefore_.contains(n)) {
            fine = wished;
            counted.erase(n);
        } else if (fine == wished) {
            counted.erase(n);
        } else if (++counted[n] > scene.in.settings.switchAfter) {
            fine = wished;
            counted.erase(n);
            if (fine) justRefined.insert(n);
        }
        if (fine != wished) ++otherThanWished;
        if (!fine) continue;
        refined.insert(n);
        open.insert(open.end(), scene[n].children.begin(), scene[n].children.end());
    }
    return finish(scene, scene.roots, refined, [&](NodeId n) {
        if (!scene[n].usable) return scene[n].unusable;
        return wish.contains(n) ? BoundBy::hysteresis : BoundBy::time;
    });
}

SlowFrame SlowRivals::erikson(SlowScene& scene) {
    const SelectInput& in = scene.in;
    double most =
        std::max(0.0, in.targetMs - in.time.fixedMs) / ((in.time.texturedMs + in.time.untexturedMs) / 2.0);
    if (in.measured.actualMs > 0.0 && in.measured.triangles > 0)
        most = static_cast<double>(in.measured.triangles) * in.targetMs / in.measured.actualMs;
    SlowSet refined;
    while (true) {
        const SlowSet left = scene.refinable(scene.roots, refined);
        const NodeId worst = scene.largest(left, [&](NodeId n) { return scene[n].errorPixels; });
        if (worst == kNoNode || scene[worst].errorPixels <= 0.0) break;
        std::int64_t triangles = scene[worst].extraTriangles;
        for (NodeId n : scene.drawn(scene.roots, refined)) triangles += scene[n].triangles;
        if (scene.below(most, static_cast<double>(triangles))) break;
        refined.insert(worst);
    }
    return finish(scene, scene.roots, refined, [&](NodeId n) {
        if (scene[n].errorPixels <= 0.0) return BoundBy::policy;
        return scene[n].usable ? BoundBy::time : scene[n].unusable;
    });
}

SlowFrame SlowRivals::screenError(SlowScene& scene) {
    const auto wanted = [&](NodeId n) { return scene[n].errorPixels > scene.in.settings.pixelThreshold; };
    SlowSet refined;
    for (std::vector<NodeId> open = scene.roots; !open.empty();) {
        const NodeId n = open.back();
        open.pop_back();
        if (!scene[n].usable || !wanted(n)) continue;
        refined.insert(n);
        open.insert(open.end(), scene[n].children.begin(), scene[n].children.end());
    }
    return finish(scene, scene.roots, refined,
                  [&](NodeId n) { return wanted(n) ? scene[n].unusable : BoundBy::policy; });
}

SlowFrame SlowRivals::coarse(SlowScene& scene) {
    SlowFrame frame = finish(scene, scene.roots, {}, [](NodeId) { return BoundBy::policy; });
    // Both are true of a root with no child in view; nobody has looked for its children.
    for (auto& [node, reason] : frame.boundBy) {
        if (reason == BoundBy::view) reason = BoundBy::policy;
    }
    return frame;
}

SlowSet SlowRivals::everythingUsable(const SlowScene& scene) {
    SlowSet refined;
    for (SlowSet left = scene.refinable(scene.roots, refined); !left.empty();
         left = scene.refinable(scene.roots, refined)) {
        refined.merge(left);
    }
    return refined;
}

SlowFrame SlowRivals::full(SlowScene& scene) {
    return finish(scene, scene.roots, everythingUsable(scene), [&](NodeId n) { return scene[n].unusable; });
}

}  // namespace fb
