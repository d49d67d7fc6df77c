#include "select/select.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "select/select_policies.h"

namespace fb {
namespace {

// A switch back within this many frames is a ping-pong (design section 7).
constexpr std::uint64_t kPingPongFrames = 35;
constexpr std::uint64_t kNever = ~std::uint64_t{0};

constexpr std::array<Policy, kPolicyCount> kPolicies = {{
    {PolicyId::lakhia, "lakhia", "Time slices with hysteresis counters, as the thesis describes them.", true,
     true, selectLakhia},
    {PolicyId::lakhiaNaive, "lakhia-naive", "Time slices without hysteresis: refines while the children fit.", true,
     false, selectLakhiaNaive},
    {PolicyId::funkhouser, "funkhouser", "All representations sorted by value; objects that do not fit are skipped.",
     false, false, selectFunkhouser},
    {PolicyId::funkhouserIncremental, "funkhouser-incremental",
     "Exchanges of the best refinement for the worst, starting from what was drawn.", false,
     false, selectFunkhouserIncremental},
    {PolicyId::macielShirley, "maciel-shirley", "Best first; each switch waits until it was wished for often enough.",
     false, false, selectMacielShirley},
    {PolicyId::erikson, "erikson", "Largest error first, up to the triangles that the last frame's time allows.", false,
     false, selectErikson},
    {PolicyId::greedy, "greedy", "Best gain for its time first, whatever fits (Mason and Blake).", false, false, selectGreedy},
    {PolicyId::screenError, "screen-error", "Refines above an error in pixels, whatever it costs: as 3D Tiles viewers do.",
     false, false, selectScreenError},
    {PolicyId::coarse, "coarse", "The roots alone: the least that can be drawn.", false, false, selectCoarse},
    {PolicyId::full, "full", "Every leaf in view, whatever it costs: the reference.", false, false, selectFull},
    {PolicyId::frontbench, "frontbench", "Our own: keeps what is drawn, and trades only for clearly more.", false,
     false, selectFrontbench},
}};

// A node whose children are all out of view is drawn in their place; that is no switch (algorithms 2 item 5).
bool standsInForUnseenChildren(const Reached& r) { return !r.expanded && r.boundBy == BoundBy::view; }

void countSwitch(const SelectInput& input, SelectState& state, const Reached& r, SelectCounters& counters) {
    const NodeId n = r.node;
    const bool reachedBefore = state.reachedFrame[n] + 1 == input.frame && state.reachedFrame[n] != kNever;
    if (standsInForUnseenChildren(r)) {
        // What was drawn before stays on record; a node that came into view ahead of its children has no record yet.
        if (reachedBefore) state.reachedFrame[n] = input.frame;
        return;
    }
    state.reachedFrame[n] = input.frame;
    const bool before = state.expanded[n] != 0;
    state.expanded[n] = r.expanded ? 1 : 0;
    if (!reachedBefore || before == r.expanded) return;

    ++(r.expanded ? counters.togglesUp : counters.togglesDown);
    const bool recent = state.toggledFrame[n] != kNever && input.frame - state.toggledFrame[n] <= kPingPongFrames;
    if (recent && (state.toggledUp[n] != 0) != r.expanded) ++counters.pingPongs;
    state.toggledFrame[n] = input.frame;
    state.toggledUp[n] = r.expanded ? 1 : 0;
}

}  // namespace

std::string_view boundByName(BoundBy reason) {
    static constexpr std::array<std::string_view, kBoundByCount> names = {"leaf",       "time",   "load",
                                                                          "hysteresis", "memory", "policy", "view"};
    return names[static_cast<std::size_t>(reason)];
}

void SelectState::reset(const Hierarchy& hierarchy, const SelectSettings& settings) {
    const std::size_t nodes = hierarchy.size();
    hysteresis.assign(nodes, settings.hystStart * settings.hystSwitch);
    reachedFrame.assign(nodes, kNever);
    expanded.assign(nodes, 0);
    toggledFrame.assign(nodes, kNever);
    toggledUp.assign(nodes, 0);
    refined.assign(nodes, 0);
    waited.assign(nodes, 0.0f);
    seenFrame.assign(nodes, kNever);
    wishedFrame.assign(nodes, kNever);
    leaves = {};
    price = restSeconds = 0.0;
    patience = 1.0;
    policy = settings.policy;
}

void SelectState::takeOver(PolicyId next, std::uint64_t frame) {
    policy = next;
    price = 0.0;
    std::ranges::fill(waited, 0.0f);
    for (std::size_t n = 0; n < refined.size(); ++n) {
        const bool reachedBefore = reachedFrame[n] + 1 == frame && reachedFrame[n] != kNever;
        refined[n] = reachedBefore ? expanded[n] : 0;
        seenFrame[n] = reachedBefore ? reachedFrame[n] : kNever;
    }
}

void Selection::clear() {
    reached.clear();
    front.clear();
    counters = {};
    frontCost = estimateMs = pressureMs = 0.0;
    triangles = texturedTriangles = 0;
}

std::span<const Policy> policies() { return kPolicies; }

const Policy& policyOf(PolicyId id) {
    const auto found = std::ranges::find(kPolicies, id, &Policy::id);
    FB_CHECK(found != kPolicies.end());
    return *found;
}

void selectFront(const SelectInput& input, SelectState& state, Selection& selection) {
    FB_CHECK(input.loaded.size() == input.hierarchy.size());
    FB_CHECK(input.memoryRefused.size() == input.hierarchy.size());
    FB_CHECK(state.expanded.size() == input.hierarchy.size());
    selection.clear();
    if (state.policy != input.settings.policy) state.takeOver(input.settings.policy, input.frame);
    const Camera &now = input.view.camera, &before = state.camera;
    const bool rests = now.eye == before.eye && now.orientation == before.orientation;
    state.restSeconds = rests ? state.restSeconds + input.dtSeconds : 0.0;
    state.movedMetres = glm::length(now.eye - before.eye);
    const glm::dquat turn = glm::conjugate(before.orientation) * now.orientation;
    state.turnedRadians = 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
    state.camera = now;
    state.patience = 1.0;
    selection.estimateMs = input.time.fixedMs;
    policyOf(input.settings.policy).select(input, state, selection);
    for (const Reached& r : selection.reached) {
        countSwitch(input, state, r, selection.counters);
        if (r.expanded) continue;
        selection.front.push_back(r.node);
        ++selection.counters.boundBy[static_cast<std::size_t>(r.boundBy)];
        selection.frontCost += nodeCost(input.hierarchy, r.node, input.settings.cTextured);
        selection.estimateMs += nodeTimeMs(input.time, input.hierarchy, r.node);
        if (input.effects[Effect::texturePressure]) {
            ++selection.counters.effectWork[Effect::texturePressure];
            selection.pressureMs += input.time.textureMsPerByte * static_cast<double>(input.hierarchy.textureBytes(r.node));
        }
        selection.triangles += input.hierarchy.triangles(r.node);
        selection.texturedTriangles += input.hierarchy.texturedTriangles[r.node];
    }
}

std::uint64_t chainFrontHash(std::uint64_t previous, std::span<const NodeId> front) {
    // One round of SplitMix64's finaliser a node: order matters, and nothing is allocated.
    std::uint64_t hash = previous ^ (0x9e3779b97f4a7c15ull * (front.size() + 1));
    for (NodeId node : front) {
        hash ^= node + 0x9e3779b97f4a7c15ull;
        hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
        hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
        hash ^= hash >> 31;
    }
    return hash;
}

}  // namespace fb
