#include "select/random_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "worlds/random_camera.h"

namespace fb {
namespace {

SelectSettings randomRivalSettings(Random& r, PolicyId policy) {
    SelectSettings s;
    s.policy = policy;
    s.cVis = r.uniform(0.0, 3.0);
    s.cFore = r.uniform(0.0, 0.99);
    s.cTextured = r.uniform(0.05, 0.95);
    s.needAllChildren = r.index(2) == 0;
    s.minDistance = r.uniform(0.1, 3.0);
    s.lookAhead = r.uniform(0.0, 1.0);
    s.switchPenalty = r.index(4) == 0 ? 0.0 : r.uniform(0.0, 0.99);
    s.switchAfter = r.index(2) == 0 ? static_cast<double>(r.index(7)) : r.uniform(0.0, 6.0);
    s.pixelThreshold = std::pow(10.0, r.uniform(0.2, 1.3));
    s.gainMeasure = r.index(2) == 0 ? GainMeasure::benefit : GainMeasure::error;
    s.margin = r.uniform(0.0, 3.0);
    s.highMark = r.uniform(1.0, 1.3);
    s.emergencyMark = r.uniform(1.0, 1.5);
    s.exchangeFactor = 1.0 + 5.0 * std::pow(r.uniform(), 3.0);  // most of them low, or exchanges are rare
    s.exchangeWait = r.index(3) == 0 ? 0.0 : r.uniform(0.0, 0.3);
    s.refineWait = r.index(8) == 0 ? 0.0 : r.uniform(0.0, 0.3);
    s.waitPixels = std::pow(10.0, r.uniform(-0.5, 3.0));
    s.urgency = r.uniform(0.01, 1.0);
    s.refineRate = 1 + static_cast<int>(r.index(5));
    s.restFactor = r.index(3) == 0 ? 1.0 : r.uniform(1.0, 8.0);
    return s;
}

// Areas, textures, and errors by levels, as checkHierarchy wants them; some nodes have none.
void randomiseErrors(Random& r, Hierarchy& h) {
    for (NodeId n = 0; n < h.size(); ++n) {
        if (r.index(8) != 0) h.areaSquareMetres[n] = static_cast<float>(r.uniform(0.1, 60.0));
        if (r.index(2) == 0) continue;
        h.textureWidth[n] = static_cast<std::uint16_t>(4 << r.index(4));
        h.textureHeight[n] = static_cast<std::uint16_t>(4 << r.index(4));
    }
    for (NodeId n = h.size(); n-- > 0;) {
        float error = r.index(6) == 0 ? 0.0f : static_cast<float>(r.uniform(0.0, 2.0));
        if (h.isLeaf(n)) error = 0.0f;
        for (NodeId child = h.firstChild[n]; child < h.firstChild[n] + h.childCount[n]; ++child) {
            error = std::max(error, h.geometricErrorMetres[child]);
        }
        h.geometricErrorMetres[n] = error;
    }
}

void changeResidency(Random& r, TinyWalk& walk) {
    for (NodeId n = walk.hierarchy.rootCount; n < walk.hierarchy.size(); ++n) {
        if (r.index(walk.loaded[n] != 0 ? 150 : 20) == 0) walk.loaded[n] ^= 1;
        walk.refused[n] = walk.loaded[n] == 0 && r.index(3) == 0 ? 1 : 0;
    }
}

// Two groups that take as much time as a dozen others each, and are worth more: room for one comes from many.
Hierarchy twoLargeAmongSmall(Random& r) {
    std::vector<TinyNode> roots;
    for (int i = 0; i < 48; ++i) {
        TinyNode root = randomNode(r, randomPoint(r, 8.0), 1.0, 1);
        const bool large = i % 24 == 0;
        const std::uint32_t least = large ? 150 + static_cast<std::uint32_t>(r.index(300)) : 5;
        root.cost = 1 + static_cast<std::uint32_t>(r.index(least));
        for (TinyNode& child : root.children) {
            child.cost = least + static_cast<std::uint32_t>(r.index(least));
            if (large) child.benefit = static_cast<float>(r.uniform(1000.0, 3000.0));
        }
        roots.push_back(root);
    }
    return makeWorld(roots);
}

Hierarchy makeRandomWorld(Random& r, PolicyId policy) {
    const bool manySmall = policy == PolicyId::frontbench && r.index(8) == 0;
    Hierarchy h = manySmall ? twoLargeAmongSmall(r) : randomWorld(r);
    randomiseErrors(r, h);
    // All nodes without benefit have the same priority. With triangles of one kind only they would also have
    // the same value, but for rounding.
    for (NodeId n = 0; n < h.size(); ++n) {
        if (h.staticBenefit[n] > 0.0f || h.texturedTriangles[n] == 0) continue;
        h.untexturedTriangles[n] += 1 + static_cast<std::uint32_t>(r.index(200));
    }
    return h;
}

}  // namespace

RandomWalk::RandomWalk(std::uint64_t seed, PolicyId policy)
    : r(seed), walk(makeRandomWorld(r, policy), randomRivalSettings(r, policy)) {
    for (bool& on : walk.effects.on) on = r.index(2) == 0;
    const Hierarchy& h = walk.hierarchy;
    for (NodeId n = 0; n < h.size(); ++n) leafTriangles += h.isLeaf(n) ? h.triangles(n) : 0;
    // With the target between the time of all leaves and a sixth of it, about half of what is in view fits.
    unitMs = r.index(4) == 0 ? 1e-3 : 1.0;
    walk.targetMs = unitMs * r.uniform(20.0, 40.0);
    const double triangleMs = walk.targetMs * std::pow(6.0, r.uniform()) / leafTriangles;
    time.texturedMs = triangleMs * r.uniform(0.3, 1.7);
    time.untexturedMs = triangleMs * r.uniform(0.3, 1.7);
    time.nodeMs = r.index(2) == 0 ? 0.0 : unitMs * r.uniform(0.0, 0.5);
    time.leastMs = r.index(2) == 0 ? triangleMs : unitMs * r.uniform(0.0, 1.0);
    moveCamera(r, walk, true);
    elsewhere = walk.view;
    moveCamera(r, walk, true);
    comesToRest = r.index(4) == 0;
}

SelectInput RandomWalk::next() {
    ++walk.frame;
    const double drift = r.uniform(0.9, 1.11);
    time.texturedMs *= drift;
    time.untexturedMs *= drift;
    time.fixedMs = unitMs * r.uniform(0.0, 3.0);
    time.slowRatio = r.uniform(0.8, 1.25);
    // Now and then so uncertain that nothing is left below the target.
    time.residualMs = r.index(20) == 0 ? walk.targetMs : unitMs * r.uniform(0.0, 2.0);
    walk.dtSeconds = r.index(15) == 0 ? 0.0 : r.uniform(0.0, 0.1);
    if (r.index(5) == 0) walk.targetMs *= r.uniform(0.9, 1.11);
    walk.measured = {};
    if (r.index(3) != 0) {
        walk.measured.triangles = static_cast<std::uint64_t>(leafTriangles * r.uniform(0.05, 1.0));
        walk.measured.actualMs = walk.targetMs * r.uniform(0.5, 2.0);
    }
    changeResidency(r, walk);
    if (comesToRest && walk.frame > 5) {
        walk.dtSeconds = r.index(15) == 0 ? 0.0 : 0.1;
    } else {
        if (r.index(8) == 0) std::swap(walk.view, elsewhere);
        moveCamera(r, walk, r.index(25) == 0);
    }
    SelectInput in = walk.input();
    in.time = time;
    return in;
}

}  // namespace fb
