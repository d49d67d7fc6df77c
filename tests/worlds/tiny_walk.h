// Runs a policy frame by frame over a tiny world: everything is loaded, every effect off, v_time 1 ms per
// unit of cost and all numbers of the priority neutral, until a test says otherwise.
#pragma once

#include <utility>

#include "select/select.h"
#include "worlds/tiny_worlds.h"

namespace fb {

using Front = std::vector<NodeId>;

// Settings under which a priority is benefit / cost for what is 1 m away, counters start at 0
// and S = 15, L = 45.
inline SelectSettings plainSettings(PolicyId policy) {
    SelectSettings settings;
    settings.policy = policy;
    settings.cVis = 0.0;
    settings.cTextured = 0.5;
    settings.minDistance = 1.0;
    settings.hystSwitch = 15.0;
    settings.hystLimit = 45.0;
    settings.hystUnit = 1.0;
    settings.hystStart = 0.0;
    settings.hystBand = false;
    return settings;
}

struct TinyWalk {
    Hierarchy hierarchy;
    SelectSettings settings;
    View view = tinyView();
    ActiveEffects effects;
    std::vector<std::uint8_t> loaded, refused;
    double vTimeMs = 1.0, overheadMs = 0.0, shareMs = 1.0, targetMs = 1.0, dtSeconds = 1.0 / 30.0;
    double slowRatio = 1.0, residualMs = 0.0, textureMsPerByte = 0.0;
    MeasuredFront measured;
    std::uint64_t frame = 0;
    SelectState state;
    Selection selection;

    TinyWalk(const std::vector<TinyNode>& roots, PolicyId policy)
        : TinyWalk(makeWorld(roots), plainSettings(policy)) {}
    TinyWalk(Hierarchy world, const SelectSettings& selectSettings)
        : hierarchy(std::move(world)),
          settings(selectSettings),
          loaded(hierarchy.size(), 1),
          refused(hierarchy.size(), 0) {
        state.reset(hierarchy, settings);
    }

    [[nodiscard]] SelectInput input() const {
        TimeModel time = timesByCost(vTimeMs, settings.cTextured, overheadMs);
        time.slowRatio = slowRatio;
        time.residualMs = residualMs;
        time.textureMsPerByte = textureMsPerByte;
        return {hierarchy, loaded,   refused,   view,  settings, effects,
                time,      shareMs,  targetMs,  dtSeconds, frame,    measured};
    }
    // One frame; gives the front in order of the ids.
    Front step() {
        ++frame;
        selectFront(input(), state, selection);
        Front front = selection.front;
        std::sort(front.begin(), front.end());
        return front;
    }
    // The first frame, counting from 1 in this call, whose front is `wanted`; 0 when it does not come in
    // `atMost`.
    int framesUntil(const Front& wanted, int atMost) {
        for (int i = 1; i <= atMost; ++i) {
            if (step() == wanted) return i;
        }
        return 0;
    }
    [[nodiscard]] BoundBy boundBy(NodeId node) const {
        for (const Reached& r : selection.reached) {
            if (r.node == node && !r.expanded) return r.boundBy;
        }
        return static_cast<BoundBy>(255);  // not in the front
    }
    [[nodiscard]] const SelectCounters& counters() const { return selection.counters; }
};

}  // namespace fb
