// Seeded random hierarchies of up to about eighty nodes with everything that is awkward in them: nodes
// without triangles, without benefit, without a normal, flat boxes, only children, roots that are leaves.
#pragma once

#include "base/random.h"
#include "settings/knob_table.h"
#include "worlds/tiny_worlds.h"

namespace fb {

inline glm::dvec3 randomPoint(Random& r, double size) {
    // One draw a statement: the order of evaluation of arguments is not fixed.
    const double x = r.uniform(-size, size);
    const double y = r.uniform(-size, size);
    const double z = r.uniform(-size, size);
    return {x, y, z};
}

inline TinyNode randomNode(Random& r, const glm::dvec3& centre, double size, int levelsBelow) {
    TinyNode node;
    node.cost = r.index(8) == 0 ? 0 : 1 + static_cast<std::uint32_t>(r.index(200));
    node.benefit = r.index(12) == 0 ? 0.0f : static_cast<float>(r.uniform(0.1, 50.0));
    const glm::dvec3 half = r.index(10) == 0 ? glm::dvec3(size, 0.0, size) : glm::abs(randomPoint(r, size));
    node.box = {glm::vec3(centre - half), glm::vec3(centre + half)};
    if (r.index(3) != 0)
        node.normal = glm::vec3(glm::normalize(randomPoint(r, 1.0) + glm::dvec3(0.0, 1e-3, 0.0)));
    if (levelsBelow == 0 || r.index(5) == 0) return node;
    const std::uint64_t children = 1 + r.index(4);
    for (std::uint64_t i = 0; i < children; ++i) {
        const glm::dvec3 childCentre = centre + randomPoint(r, size);
        node.children.push_back(randomNode(r, childCentre, 0.6 * size, levelsBelow - 1));
    }
    return node;
}

inline Hierarchy randomWorld(Random& r) {
    std::vector<TinyNode> roots;
    const std::uint64_t count = 1 + r.index(4);
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 centre = randomPoint(r, 15.0);
        roots.push_back(randomNode(r, centre, r.uniform(1.0, 8.0), 3));
    }
    Hierarchy h = makeWorld(roots);
    for (NodeId n = 0; n < h.size(); ++n) {
        if (r.index(2) == 0) h.untexturedTriangles[n] = static_cast<std::uint32_t>(r.index(200));
    }
    return h;
}

// Any value that the gate admits; big ranges by their order of magnitude.
inline double randomAdmissible(Random& r, const Knob& knob) {
    if (knob.type == KnobType::real) {
        const std::uint64_t kind = r.index(8);
        if (kind == 0) return knob.low;
        if (kind == 1) return knob.high;
        if (knob.low > 0.0 && knob.high / knob.low > 100.0) {
            const double value = knob.low * std::pow(knob.high / knob.low, r.uniform());
            return std::min(std::max(value, knob.low), knob.high);
        }
        return r.uniform(knob.low, knob.high);
    }
    return knob.low + static_cast<double>(r.index(static_cast<std::uint64_t>(knob.high - knob.low) + 1));
}

// Every knob of the group at random, the rules between knobs kept.
inline void randomiseGroup(Random& r, Settings& settings, std::string_view group) {
    for (const Knob& knob : knobs()) {
        if (knob.group == group) knob.set(settings, randomAdmissible(r, knob));
    }
    if (settings.select.hystSwitch > settings.select.hystLimit) {
        std::swap(settings.select.hystSwitch, settings.select.hystLimit);
        settings.select.hystSwitch =
            std::min(settings.select.hystSwitch, findKnob("select.hyst_switch")->high);
    }
}

}  // namespace fb
