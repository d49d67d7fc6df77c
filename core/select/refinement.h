// The nodes that a policy reaches in one frame, and what drawing the children of each in its place would bring and
// take (algorithms 3.2). Grown by the policies from the visible roots downward; what is not expanded at the end is the
// front. Scratch of SelectState: allocates nothing once it has grown.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "settings/settings.h"

namespace fb {

struct SelectInput;
struct SelectState;
struct Selection;

// Why a node of the front was not refined: what binds. `view`: it has children, but none of them is in view.
enum class BoundBy : std::uint8_t { leaf, time, load, hysteresis, memory, policy, view };
inline constexpr int kBoundByCount = 7;
[[nodiscard]] std::string_view boundByName(BoundBy reason);

struct Refinement {
    NodeId node = kNoNode;
    std::uint32_t parent = 0;  // index, or kNoRefinement for roots
    std::uint32_t firstChild = 0, childCount = 0;  // its visible children, in RefinementTree::children
    double priority = 0.0;  // of roots alone
    double ownMs = 0.0;
    double extraMs = 0.0;  // time of the visible children less its own: may be below 0
    double gain = 0.0;     // benefit, always > 0
    double value = 0.0;    // gain per ms
    std::uint32_t firstNode = ~std::uint32_t{0};  // of its children, once it has been expanded in this frame
    std::uint32_t expandedChildren = 0;
    BoundBy boundBy = BoundBy::leaf;
    bool usable = false;  // children are in view and loaded: it may be expanded
    bool expanded = false;
    bool isNew = false;     // policy frontbench: not in the picture before, or not there (algorithms section 3)
    double needMs = 0.0, hadMs = 0.0;  // see Reached
};
inline constexpr std::uint32_t kNoRefinement = ~std::uint32_t{0};

struct RefinementTree {
    std::vector<Refinement> nodes;  // parents before their children
    std::vector<NodeId> children;

    // Begins with the visible roots; `gain`: what a refinement is said to bring.
    void start(const SelectInput& input, SelectState& state, Selection& selection,
               GainMeasure gain = GainMeasure::benefit);
    // The visible children of a usable node are drawn in its place; the first time they are put at the end of `nodes`.
    void expand(std::uint32_t index, const SelectInput& input, SelectState& state, Selection& selection);
    // The other way, for one whose children are not expanded; they stay in `nodes`, without being drawn.
    void collapse(std::uint32_t index);
    [[nodiscard]] bool isInnermost(std::uint32_t index) const {
        return nodes[index].expanded && nodes[index].expandedChildren == 0;
    }
    // What is reached by way of expanded nodes becomes the selection.
    void finish(Selection& selection) const;
    // Only innermost nodes are collapsed: whatever is expanded is reached.
    [[nodiscard]] bool isReached(const Refinement& r) const {
        return r.parent == kNoRefinement || nodes[r.parent].expanded;
    }
    // What the nodes that are drawn take together.
    [[nodiscard]] double drawnMs() const;

  private:
    void add(NodeId node, std::uint32_t parent, const SelectInput& input, SelectState& state, Selection& selection);
    void weigh(Refinement& refinement, const SelectInput& input, const SelectState& state) const;

    GainMeasure gain_ = GainMeasure::benefit;
};

// For heaps of indices: the one of the highest value first, or of the lowest; the lowest id among equals.
struct ByValue {
    const RefinementTree& tree;
    bool lowestFirst = false;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
        const Refinement &x = tree.nodes[a], &y = tree.nodes[b];
        if (x.value != y.value) return lowestFirst ? x.value > y.value : x.value < y.value;
        return x.node > y.node;
    }
};

}  // namespace fb
