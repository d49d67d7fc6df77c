// A second implementation of the policy frontbench for tests, from algorithms 3: sets, full searches, totals
// summed up anew for every question.
#pragma once

#include "select/slow_scene.h"

namespace fb {

class SlowFrontbench {
  public:
    SlowFrame step(const SelectInput& input);

    double price = 0.0;
    std::map<NodeId, float> waited;  // seconds; a node that is not in it has not waited
    // How often each thing happened.
    std::uint64_t coarsened = 0, refinements = 0, newRefinements = 0, exchanges = 0, exchangesAwaited = 0;
    std::uint64_t exchangesOfSeveral = 0, cameAsRefined = 0, patientFrames = 0;
    std::uint64_t cutNodes = 0, newExchanges = 0, arrivals = 0;

  private:
    struct Limits {
        double perEstimate;  // total / now
        double mid, limit;
    };
    struct Exchange {
        SlowSet givenUp;  // empty: none makes room
        double ratio = 0.0;
    };
    [[nodiscard]] double totalMs(const SlowScene& scene, const Limits& limits) const;
    [[nodiscard]] SlowSet refinedNow(const SlowScene& scene) const;
    // Item 4's innermost nodes that take more time than the node itself.
    [[nodiscard]] SlowSet mayCoarsen(SlowScene& scene) const;
    void goOn(SlowScene& scene);
    [[nodiscard]] Limits limits(SlowScene& scene) const;
    void makeRoom(SlowScene& scene, const Limits& limits);
    void improve(SlowScene& scene, const Limits& limits);
    static double sooner(const SlowScene& scene, NodeId n);
    [[nodiscard]] Exchange exchangeFor(SlowScene& scene, const Limits& limits, NodeId node) const;
    void refine(const SlowScene& scene, NodeId node);

    SlowSet wanted_;         // refined; also of nodes that are not reached now
    SlowSet reachedBefore_;  // in the frame before
    SlowSet new_;            // not in the picture before, or elsewhere in it
    SlowSet waits_;          // would be refined, but not in this frame
    SlowSwitches switches_;
    double restSeconds_ = 0.0, patience_ = 1.0;
    double movedMetres_ = 0.0, turnedRadians_ = 0.0;
    Camera cameraBefore_;
};

}  // namespace fb
