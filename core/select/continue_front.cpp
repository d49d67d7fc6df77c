#include "select/continue_front.h"

namespace fb {
namespace {

constexpr double kEnterLess = 0.77, kEnterMore = 1.3;  // of the price: what comes into view, refined before or not
constexpr double kCutRadians = 0.3;                    // by which what is seen moves in the picture in one frame

// Whether the camera has moved or turned so much in one frame that the node's picture is another: a cut.
bool isElsewhere(const SelectInput& input, const SelectState& state, NodeId node) {
    const Box3f& bounds = input.hierarchy.bounds[node];
    const Box3d box{glm::dvec3(bounds.min), glm::dvec3(bounds.max)};
    const double distance = glm::length(box.centre() - input.view.camera.eye);
    return state.movedMetres > (kCutRadians - state.turnedRadians) * distance;
}

}  // namespace

void continueFront(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {  // grows
        Refinement& r = tree.nodes[i];
        const bool wasSeen = state.wasSeen(r.node, input.frame);
        state.seenFrame[r.node] = input.frame;
        r.isNew = !wasSeen || isElsewhere(input, state, r.node);
        if (!r.usable) {
            state.setRefined(r.node, false);
            if (r.childCount > 0) state.waited[r.node] = kWaitedForData;
            continue;
        }
        if (!wasSeen) {
            const bool before = state.refined[r.node] != 0;
            const double bar = state.price * (before ? kEnterLess : kEnterMore);
            state.setRefined(r.node, state.price > 0.0 ? r.value > bar : before);
        }
        if (state.refined[r.node] != 0) tree.expand(i, input, state, selection);
    }
}

}  // namespace fb
