// Selecting the front: hierarchy + residency + view + time -> the nodes drawn this frame, with the reason why each is
// not finer. One signature for every policy (one file each, table in select.cpp).
// A selection allocates nothing once its vectors have grown, and costs in proportion to the nodes it visits.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "effects/effects.h"
#include "scenefile/hierarchy.h"
#include "select/refinement.h"
#include "select/time_model.h"
#include "select/view.h"
#include "settings/settings.h"

namespace fb {

// What was drawn and how long it took; all 0 before the first time is known.
struct MeasuredFront {
    std::uint64_t triangles = 0;
    double actualMs = 0.0;
};

struct SelectInput {
    const Hierarchy& hierarchy;
    std::span<const std::uint8_t> loaded;         // one a node, 1: may be drawn; one snapshot for the whole frame
    std::span<const std::uint8_t> memoryRefused;  // one a node, 1: not loaded because the budget has no room for it
    const View& view;
    const SelectSettings& settings;
    const ActiveEffects& effects;
    TimeModel time;
    double shareMs = 0.0;     // share time of the roots
    double targetMs = 0.0;    // T
    double dtSeconds = 0.0;   // clamped to [0, 0.1]
    std::uint64_t frame = 0;  // counts up by one a frame, starts at 1
    MeasuredFront measured;   // the newest frame whose time is known
};

// What all leaves below each node hold together; empty until the effect redistribution asks for it.
struct LeavesBelow {
    std::vector<double> textured, untextured, count;
};

// What a policy keeps from frame to frame. Per node, valid only where the stamp says so.
struct SelectState {
    std::vector<double> hysteresis;             // h, in double: small increments at large h vanish in float
    std::vector<std::uint64_t> reachedFrame;    // last frame up to which `expanded` is known without a gap
    std::vector<std::uint8_t> expanded;         // whether its children were drawn when some of them were in view
    std::vector<std::uint64_t> toggledFrame;    // last switch, for ping-pongs
    std::vector<std::int8_t> toggledUp;
    // Of the policies that change what they drew before instead of choosing afresh.
    std::vector<std::uint8_t> refined;          // whether the policy wants its children drawn
    std::vector<float> waited;                  // for a switch: seconds (frontbench), frames (maciel-shirley)
    std::vector<std::uint64_t> seenFrame;       // last frame in which it was reached
    std::vector<std::uint64_t> wishedFrame;     // last frame in which the best front had its children
    double price = 0.0;                         // gain per ms at which time changes hands now; 0: not known yet
    double restSeconds = 0.0;                   // for which the camera has not moved or turned
    double patience = 1.0;                      // of frontbench with a camera at rest (algorithms 3 item 4)
    Camera camera;                              // of the frame before
    double movedMetres = 0.0, turnedRadians = 0.0;  // the camera since then
    PolicyId policy = PolicyId::lakhia;         // of the frame before

    LeavesBelow leaves;
    std::vector<NodeId> queue, group;           // scratch
    std::vector<double> shares, slices, priorities;  // scratch
    std::vector<std::uint8_t> marks;            // scratch
    RefinementTree tree;                        // scratch
    std::vector<std::uint32_t> heap, heapDown;  // scratch

    // Forgets everything; counters start at settings.hystStart * hystSwitch.
    void reset(const Hierarchy& hierarchy, const SelectSettings& settings);
    // Another policy begins with what is drawn.
    void takeOver(PolicyId next, std::uint64_t frame);
    [[nodiscard]] bool wasSeen(NodeId node, std::uint64_t frame) const { return seenFrame[node] + 1 == frame; }
    // A new state has not waited for the next.
    void setRefined(NodeId node, bool isRefined) {
        refined[node] = isRefined ? 1 : 0;
        waited[node] = 0.0f;
    }
};

struct Reached {
    NodeId node;
    bool expanded;    // its visible children were taken instead of it
    BoundBy boundBy;  // meaningful where not expanded
    // What refining it would take and the time there was for that, as the policy counts it; 0 where nobody asked.
    double needMs = 0.0, hadMs = 0.0;
};

struct SelectCounters {
    std::uint32_t visited = 0;         // nodes whose visibility was tested
    std::uint32_t refusedGroups = 0;   // fully loaded groups refused by their siblings' sum or by time
    std::uint32_t skippedRoots = 0;    // in view, and not drawn at all
    std::uint32_t repairedPriorities = 0, repairedCounters = 0;
    std::uint32_t togglesUp = 0, togglesDown = 0, pingPongs = 0;
    std::uint32_t boundBy[kBoundByCount] = {};
    EffectWork effectWork;
};

struct Selection {
    std::vector<Reached> reached;  // in the order of the traversal
    std::vector<NodeId> front;     // the reached nodes that are not expanded: what is drawn
    SelectCounters counters;
    double frontCost = 0.0;        // sum of nodeCost
    double estimateMs = 0.0;       // time.fixedMs + sum of nodeTimeMs
    double pressureMs = 0.0;       // of it, what textures that do not fit take
    std::uint64_t triangles = 0, texturedTriangles = 0;

    void clear();
};

struct Policy {
    PolicyId id;
    std::string_view name, help;
    bool usesShareTime;  // the second feedback loop belongs to it
    bool hasCounters;    // of hysteresis: slices may change without a switch in each frame
    void (*select)(const SelectInput&, SelectState&, Selection&);
};
[[nodiscard]] std::span<const Policy> policies();
[[nodiscard]] const Policy& policyOf(PolicyId id);

// Runs the policy of the settings, then counts switches against the frame before (thesis 6.5: one per group, nodes
// that were culled away do not count) and sums up the front.
void selectFront(const SelectInput& input, SelectState& state, Selection& selection);

// 64-bit hash of the front of one frame, chained: the same walk gives the same value on every machine.
[[nodiscard]] std::uint64_t chainFrontHash(std::uint64_t previous, std::span<const NodeId> front);

}  // namespace fb
