// Where cars are parked, trees and lamp posts stand, and machinery is set up on roofs.
#include <algorithm>

#include "base/random.h"
#include "import/city_lumps.h"

namespace fb::city {
namespace {

std::uint32_t drawSeed(Random& random) {
    return static_cast<std::uint32_t>(random.bits() >> 32);
}

// A kerb along one side of the unit's built area; `toStreet` points from the pavement to the carriageway.
struct Kerb {
    glm::dvec3 from, to, toStreet;

    [[nodiscard]] double length() const { return glm::length(to - from); }
    [[nodiscard]] glm::dvec3 at(double metres) const { return from + (to - from) * (metres / length()); }
};

std::vector<Kerb> kerbsOf(const CityPlan& plan, const Unit& unit) {
    std::vector<Kerb> kerbs;
    const Rect& b = unit.built;
    const auto pavementBeside = [](const std::vector<Street>& streets, double wall, double sign) {
        for (const Street& s : streets) {
            const double gap = s.centre - wall - sign * s.halfWidth();
            if (gap > -0.01 && gap < 0.01) return s.pavement;
        }
        return 0.0;  // no street here
    };
    const double south = pavementBeside(plan.alongX, b.z1, 1.0),
                 north = pavementBeside(plan.alongX, b.z0, -1.0);
    const double east = pavementBeside(plan.alongZ, b.x1, 1.0),
                 west = pavementBeside(plan.alongZ, b.x0, -1.0);
    if (south > 0.0) kerbs.push_back({{b.x0, 0, b.z1 + south}, {b.x1, 0, b.z1 + south}, {0, 0, 1}});
    if (north > 0.0) kerbs.push_back({{b.x0, 0, b.z0 - north}, {b.x1, 0, b.z0 - north}, {0, 0, -1}});
    if (east > 0.0) kerbs.push_back({{b.x1 + east, 0, b.z0}, {b.x1 + east, 0, b.z1}, {1, 0, 0}});
    if (west > 0.0) kerbs.push_back({{b.x0 - west, 0, b.z0}, {b.x0 - west, 0, b.z1}, {-1, 0, 0}});
    return kerbs;
}

Thing makeCar(Random& random, const glm::dvec3& place, bool alongX) {
    const double kind = random.uniform();
    const double length = kind < 0.8 ? random.uniform(3.8, 4.7) : random.uniform(4.8, 5.4);
    const double width = random.uniform(1.68, 1.86);
    const double height = kind < 0.6 ? random.uniform(1.35, 1.5) : random.uniform(1.6, 1.95);
    const glm::dvec3 size = alongX ? glm::dvec3(length, height, width) : glm::dvec3(width, height, length);
    return {{LumpShape::car, place - glm::dvec3(0.0, 0.05, 0.0), size, 0.05, drawSeed(random)}};
}

Thing makeTree(Random& random, const glm::dvec3& place) {
    const double trunk = random.uniform(2.4, 3.2), crown = random.uniform(2.2, 3.2);
    Thing tree;
    tree.push_back({LumpShape::box, place, {0.28, trunk + 0.5, 0.26}, 0.02, drawSeed(random)});
    tree.push_back({LumpShape::ball, place + glm::dvec3(0, trunk, 0),
                    glm::dvec3(crown, crown * random.uniform(1.0, 1.4), crown), 0.3, drawSeed(random), true});
    return tree;
}

Thing makeLamp(Random& random, const glm::dvec3& place, const glm::dvec3& toStreet) {
    Thing lamp;
    const glm::dvec3 arm = glm::abs(toStreet) * 1.0 + glm::dvec3(0.12, 0.1, 0.12);
    lamp.push_back({LumpShape::box, place, {0.16, 6.2, 0.16}, 0.01, drawSeed(random)});
    lamp.push_back(
        {LumpShape::box, place + toStreet * 0.5 + glm::dvec3(0, 6.1, 0), arm, 0.01, drawSeed(random), true});
    return lamp;
}

void furnishKerb(Random& random, const Kerb& kerb, std::vector<Thing>& things) {
    const bool alongX = kerb.toStreet.x == 0.0;
    const double length = kerb.length();
    const double parked = random.uniform(0.35, 0.85), planted = random.uniform(0.2, 0.8);
    for (double at = 5.0; at < length - 5.0; at += random.uniform(5.9, 6.8)) {
        if (random.uniform() >= parked) continue;
        const double gap = random.uniform(1.05, 1.25);
        things.push_back(makeCar(random, kerb.at(at) + kerb.toStreet * gap, alongX));
    }
    for (double at = 3.5; at < length - 2.0; at += random.uniform(7.0, 10.0)) {
        const glm::dvec3 place = kerb.at(at) - kerb.toStreet * 0.7 + glm::dvec3(0, kPavementHeight - 0.1, 0);
        const double u = random.uniform();
        if (u < planted) {
            things.push_back(makeTree(random, place));
        } else if (u < planted + 0.25) {
            things.push_back(makeLamp(random, place, kerb.toStreet));
        }
    }
}

void furnishRoof(Random& random, const Building& building, std::vector<Thing>& things) {
    if (building.roof != RoofShape::flat) return;
    const Rect& f = building.footprint;
    // Away from parapets and cut-off corners.
    const double margin = 2.2;
    if (f.width() < 2.0 * margin + 2.0 || f.depth() < 2.0 * margin + 2.0) return;
    const auto place = [&](double below) {
        const double x = random.uniform(f.x0 + margin, f.x1 - margin);
        const double z = random.uniform(f.z0 + margin, f.z1 - margin);
        return glm::dvec3(x, building.roofY() - below, z);
    };
    if (building.floors >= 3) {  // the stairs' head or the lift's machine room
        const glm::dvec3 at = place(0.1);
        const double height = random.uniform(1.9, 2.7), width = random.uniform(2.2, 3.4);
        things.push_back(
            {{LumpShape::box, at, {width, height, random.uniform(2.2, 3.0)}, 0.02, drawSeed(random)}});
    }
    const auto machines = random.index(4);
    for (std::uint64_t i = 0; i < machines; ++i) {
        const glm::dvec3 at = place(0.1);
        const double width = random.uniform(0.6, 1.8), height = random.uniform(0.5, 1.3);
        things.push_back(
            {{LumpShape::box, at, {width, height, random.uniform(0.6, 1.6)}, 0.03, drawSeed(random)}});
    }
}

void furnishCarPark(Random& random, const Rect& park, std::vector<Thing>& things) {
    for (double z = park.z0 + 3.5; z < park.z1 - 3.0; z += 7.5) {
        for (double x = park.x0 + 2.0; x < park.x1 - 1.5; x += 2.7) {
            if (random.uniform() < 0.55) things.push_back(makeCar(random, {x, kPavementHeight, z}, false));
        }
    }
}

}  // namespace

std::vector<Thing> placeThings(const CityPlan& plan, const Unit& unit) {
    Random random = Random::forPart(unit.seed, 2);
    std::vector<Thing> things;
    for (const Kerb& kerb : kerbsOf(plan, unit)) furnishKerb(random, kerb, things);
    for (const Building& building : unit.buildings) furnishRoof(random, building, things);
    for (const Rect& park : unit.carParks) furnishCarPark(random, park, things);
    // Shuffled, so that leaving out the last ones thins all kinds and places alike.
    for (std::size_t i = things.size(); i > 1; --i) std::swap(things[i - 1], things[random.index(i)]);
    return things;
}

}  // namespace fb::city
