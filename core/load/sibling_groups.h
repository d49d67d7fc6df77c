// The sibling groups that loading deals in: the children of each resident node, with what memory they hold or
// lack and how much they matter now. Made afresh in each frame by planLoads.
//
// Priority of a group: the greatest of its members' (priority.h), never above that of the group above it.
// Distance is to the nearest point, so a child can rank above its parent; under the cap, an order by falling
// priority puts every group after the one that it hangs from, and one by rising priority (deeper levels first
// among equals) evicts no parent before its children. It follows from the camera and the hierarchy alone, not
// from what is loaded, and a group is evicted or stopped only for one of higher priority. So with a still
// camera the list of held groups by falling priority only grows in lexicographic order: it comes to rest.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "effects/effects.h"

namespace fb {

struct PlanInput;
struct Residency;

inline constexpr std::uint32_t kNoGroup = ~std::uint32_t{0};

struct SiblingGroup {
    // Some of the members.
    struct Part {
        std::uint32_t members = 0;
        std::uint64_t bytes = 0;
        void add(const Part& other) {
            members += other.members;
            bytes += other.bytes;
        }
        void remove(const Part& other) {
            members -= other.members;
            bytes -= other.bytes;
        }
    };

    NodeId parent = kNoNode;         // resident; the members are its children
    std::uint32_t above = kNoGroup;  // group that the parent is a member of; none for the children of a root
    double priority = 0.0;           // 0 where hopeless
    Part held;                       // resident or in flight
    Part inFlight;
    Part missing;           // not held, and not failed for good
    bool complete = false;  // all members are resident
    bool broken = false;    // a member has failed for good: never complete, nothing more is loaded
    bool hopeless = false;  // no member can ever be drawn: broken while all are needed, or below such a group
    bool waiting =
        false;            // may not be loaded yet: a member has just failed, or the group above is incomplete
    bool usable = false;  // its members' children could be drawn
    bool pinned = false;  // holds a node of the front, or hangs above one that does
    bool evicted = false;  // in this frame
    bool barred = false;   // not loaded yet: it was evicted a moment ago, for something that matters more
};

struct SiblingGroups {
    std::vector<SiblingGroup> groups;    // by level from the top
    std::vector<std::uint32_t> groupOf;  // by node, valid for this frame's parents: the group of its children
    std::vector<NodeId> parents;         // scratch
    EffectWork effectWork;               // of this plan
};

// Also clears memoryRefused of all members; planLoads sets it anew.
void gatherSiblingGroups(const PlanInput& input, Residency& residency, SiblingGroups& into);

}  // namespace fb
