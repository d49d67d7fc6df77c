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
#include "select/view.h"
#include "settings/settings.h"

namespace fb {

// Why a node of the front was not refined: what binds.
enum class BoundBy : std::uint8_t { leaf, time, load, hysteresis, memory, policy };
inline constexpr int kBoundByCount = 6;
[[nodiscard]] std::string_view boundByName(BoundBy reason);

struct SelectInput {
    const Hierarchy& hierarchy;
    std::span<const std::uint8_t> loaded;         // one a node, 1: may be drawn; one snapshot for the whole frame
    std::span<const std::uint8_t> memoryRefused;  // one a node, 1: not loaded because the budget has no room for it
    const View& view;
    const SelectSettings& settings;
    const ActiveEffects& effects;
    double vTimeMs = 0.0;     // ms per unit of cost
    double overheadMs = 0.0;  // O
    double shareMs = 0.0;     // share time of the roots
    double targetMs = 0.0;    // T
    double dtSeconds = 0.0;   // clamped to [0, 0.1]
    std::uint64_t frame = 0;  // counts up by one a frame, starts at 1
};

// What a policy keeps from frame to frame. Per node, valid only where the stamp says so.
struct SelectState {
    std::vector<double> hysteresis;             // h, in double: small increments at large h vanish in float
    std::vector<std::uint64_t> reachedFrame;    // last frame up to which `expanded` is known without a gap
    std::vector<std::uint8_t> expanded;         // whether its children were drawn when some of them were in view
    std::vector<std::uint64_t> toggledFrame;    // last switch, for ping-pongs
    std::vector<std::int8_t> toggledUp;
    std::vector<NodeId> queue, group;           // scratch
    std::vector<double> shares, priorities;     // scratch

    // Forgets everything; counters start at settings.hystStart * hystSwitch.
    void reset(const Hierarchy& hierarchy, const SelectSettings& settings);
};

struct Reached {
    NodeId node;
    bool expanded;    // its visible children were taken instead of it
    BoundBy boundBy;  // meaningful where not expanded
};

struct SelectCounters {
    std::uint32_t visited = 0;         // nodes whose visibility was tested
    std::uint32_t refusedGroups = 0;   // fully loaded groups refused by their siblings' sum or by time
    std::uint32_t repairedPriorities = 0, repairedCounters = 0;
    std::uint32_t togglesUp = 0, togglesDown = 0, pingPongs = 0;
    std::uint32_t boundBy[kBoundByCount] = {};
};

struct Selection {
    std::vector<Reached> reached;  // in the order of the traversal
    std::vector<NodeId> front;     // the reached nodes that are not expanded: what is drawn
    SelectCounters counters;
    double frontCost = 0.0;        // sum of nodeCost
    std::uint64_t triangles = 0, texturedTriangles = 0;

    void clear();
};

struct Policy {
    PolicyId id;
    std::string_view name, help;
    bool usesShareTime;  // the second feedback loop belongs to it
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
