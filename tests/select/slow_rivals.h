// A second implementation of the policies of algorithms 2.1 other than lakhia-naive, for tests: sets instead
// of heaps, every choice is a search through everything that could be chosen, every total is summed up anew.
#pragma once

#include "select/slow_scene.h"

namespace fb {

class SlowRivals {
  public:
    SlowFrame step(const SelectInput& input);  // the policy of the settings, which must stay the same

    std::map<NodeId, double> counted;  // maciel-shirley: frames; a node that is not in it has counted none
    // How often what makes a policy different happened.
    std::uint64_t takenBack = 0, madeAndTakenBack = 0, otherThanWished = 0, passedOver = 0;

  private:
    SlowFrame greedy(SlowScene& scene);
    SlowFrame funkhouser(SlowScene& scene);
    SlowFrame incremental(SlowScene& scene);
    SlowFrame macielShirley(SlowScene& scene);
    SlowFrame erikson(SlowScene& scene);
    SlowFrame screenError(SlowScene& scene);
    SlowFrame coarse(SlowScene& scene);
    SlowFrame full(SlowScene& scene);

    static SlowSet everythingUsable(const SlowScene& scene);
    static SlowSet greedyWish(SlowScene& scene);
    SlowSet takeBack(SlowScene& scene, SlowSet& refined);
    double rootValue(const SlowScene& scene, NodeId root);
    double refinementValue(const SlowScene& scene, NodeId node);
    // `reason` is asked for the drawn nodes that have something finer in view.
    template <class Reason>
    SlowFrame finish(SlowScene& scene, const std::vector<NodeId>& from, const SlowSet& refined,
                     Reason reason);

    SlowSet reachedBefore_, refinedBefore_;  // in the frame before
    SlowSwitches switches_;
};

template <class Reason>
SlowFrame SlowRivals::finish(SlowScene& scene, const std::vector<NodeId>& from, const SlowSet& refined,
                             Reason reason) {
    SlowFrame frame = scene.finish(from, refined, switches_, [&](NodeId n) {
        return scene[n].children.empty() ? scene[n].unusable : reason(n);
    });
    frame.skippedRoots = static_cast<std::uint32_t>(scene.roots.size() - from.size());
    reachedBefore_ = scene.reached(from, refined);
    refinedBefore_ = refined;
    return frame;
}

}  // namespace fb
