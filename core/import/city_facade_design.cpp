// Designs the facades of a building: the lines of its walls in plan, then floors and bays with their openings
// and ornaments in whole decimetres.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "import/city_facade.h"
#include "import/city_noise.h"

namespace fb::city {
namespace {

constexpr std::array kDirections{glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(-1, 0), glm::dvec2(0, 1)};

glm::dvec2 cornerOf(const Building& b, int wall) {  // at the wall's end
    const Rect& f = b.footprint;
    return {wall == kSouth || wall == kEast ? f.x1 : f.x0, wall == kSouth || wall == kWest ? f.z1 : f.z0};
}

glm::dvec2 wallStart(const Building& b, int wall) {
    const int before = (wall + 3) % 4;
    return cornerOf(b, before) + kDirections[wall] * b.chamfer[before];
}

glm::dvec2 wallEnd(const Building& b, int wall) {
    return cornerOf(b, wall) - kDirections[wall] * b.chamfer[wall];
}

// The line along `count` walls from `first` on, cut-off corners between them included.
void setLine(Facade& facade, const Building& b, int first, int count) {
    for (int i = 0; i < count; ++i) {
        const int wall = (first + i) % 4;
        const glm::dvec2 start = wallStart(b, wall);
        if (i == 0 || b.chamfer[(wall + 3) % 4] > 0.0) facade.line.push_back(start);
        facade.line.push_back(wallEnd(b, wall));
    }
    facade.starts.push_back(0.0);
    for (std::size_t i = 1; i < facade.line.size(); ++i) {
        const glm::dvec2 way = facade.line[i] - facade.line[i - 1];
        const double length = std::sqrt(glm::dot(way, way));
        facade.starts.push_back(facade.starts.back() + length);
        facade.normals.push_back(glm::dvec2(-way.y, way.x) / length);
    }
}

// The bays of one segment: windows of `width` every `pitch` decimetres from `first`.
struct Bays {
    int length = 0, count = 0, pitch = 0, first = 0, width = 0;

    [[nodiscard]] int left(int bay) const { return first + bay * pitch; }
    [[nodiscard]] int right(int bay) const { return left(bay) + width; }
};

Bays layBays(const Facade& facade, int segment, int bay, int width) {
    Bays bays;
    bays.length =
        static_cast<int>(std::floor((facade.starts[segment + 1] - facade.starts[segment]) * 10.0 + 1e-6));
    if (bays.length < 14) return bays;
    bays.count = std::max(1, (bays.length - 6) / bay);
    bays.pitch = (bays.length - 6) / bays.count;
    bays.width = std::min(std::min(width, bays.pitch - 4), bays.length - 8);
    bays.first = (bays.length - bays.count * bays.pitch) / 2 + (bays.pitch - bays.width) / 2;
    return bays;
}

struct Designer {
    const Building& building;
    Facade& facade;
    Random random;
    int ground, floor, upper;  // decimetres: height of the ground floor, of the others, top of the last one

    std::uint32_t look() { return static_cast<std::uint32_t>(random.bits() >> 32); }
    int storey(int number) const {
        return ground + (number - 1) * floor;
    }  // y of its floor; 1 is above the ground

    void relief(int segment, const DesignRect& at, double low, double high, ReliefKind kind,
                bool fine = false) {
        facade.reliefs.push_back({segment, at, low, high, kind, look(), fine});
    }
    void groundFloor(int segment, const Bays& bays, bool mainSegment);
    void shopFronts(int segment, const Bays& bays, int doorBay);
    void upperFloors(int segment, const Bays& bays);
    void bayWindows(int segment, const Bays& bays);
    void ledges();
};

void Designer::shopFronts(int segment, const Bays& bays, int doorBay) {
    const BuildingStyle& style = facade.style;
    const int top = ground - 11;
    for (int i = 0; i < bays.count;) {
        if (i == doorBay) {
            facade.openings.push_back(
                {segment, {bays.left(i), bays.right(i), 1, top}, 0.35, OpeningKind::door, look(), false});
            ++i;
            continue;
        }
        int group = 1 + static_cast<int>(random.index(3));
        while (group > 1 && (i + group > bays.count || (doorBay > i && doorBay < i + group))) --group;
        // Edges are shared where they can be: each one costs lines across the whole facade.
        const DesignRect at{bays.left(i), bays.right(i + group - 1), 1, top};
        facade.openings.push_back({segment, at, 0.25, OpeningKind::shop, look(), false});
        if (style.awnings) {
            relief(segment, {at.s0, at.s1, top, top + 6}, random.uniform(0.7, 1.1), 0.06, ReliefKind::awning);
        } else if (group > 1 || random.uniform() < 0.5) {
            relief(segment, {at.s0, at.s1, top + 2, top + 7}, 0.1, 0.1, ReliefKind::sign, true);
        }
        i += group;
    }
}

void Designer::groundFloor(int segment, const Bays& bays, bool mainSegment) {
    const BuildingStyle& style = facade.style;
    const int doorBay = mainSegment || bays.count == 1 ? static_cast<int>(random.index(bays.count)) : -1;
    if (building.shop && facade.role == FacadeRole::front) {
        shopFronts(segment, bays, doorBay);
        return;
    }
    const bool garage = facade.role == FacadeRole::back && random.uniform() < 0.4;
    for (int i = 0; i < bays.count; ++i) {
        if (i == doorBay) {
            facade.openings.push_back(
                {segment, {bays.left(i), bays.right(i), 1, 23}, 0.22, OpeningKind::door, look(), false});
        } else if (garage && i + 1 == bays.count) {
            facade.openings.push_back(
                {segment, {bays.left(i), bays.right(i), 1, 24}, 0.15, OpeningKind::garage, look(), false});
        } else {
            const int sill = style.sill + 2, high = std::min(style.windowHeight, ground - sill - 6);
            facade.openings.push_back({segment,
                                       {bays.left(i), bays.right(i), sill, sill + high},
                                       style.recess,
                                       OpeningKind::window,
                                       look(),
                                       false});
        }
    }
}

void Designer::bayWindows(int segment, const Bays& bays) {
    // One bay in two or three stands out over all upper floors but the last.
    const int every = 2 + static_cast<int>(random.index(2));
    const int low = ground + 2, high = storey(building.floors - 1) - 1;
    for (int i = static_cast<int>(random.index(2)); i < bays.count; i += every) {
        const int side = std::min(4, (bays.pitch - bays.width) / 2 - 1);
        if (side < 2 || high - low < floor / 2 || bays.left(i) - side < 2) continue;
        relief(segment, {bays.left(i) - side, bays.right(i) + side, low, high}, 0.75, 0.75,
               ReliefKind::bayWindow);
    }
}

void Designer::upperFloors(int segment, const Bays& bays) {
    const BuildingStyle& style = facade.style;
    const auto inBayWindow = [&](const DesignRect& at) {
        return std::any_of(facade.reliefs.begin(), facade.reliefs.end(), [&](const Relief& r) {
            return r.kind == ReliefKind::bayWindow && r.segment == segment && at.s0 > r.at.s0 &&
                   at.s1 < r.at.s1 && at.y0 > r.at.y0 && at.y1 < r.at.y1;
        });
    };
    const bool oneBalcony = random.uniform() < 0.6;  // along the whole floor, not one a window
    const double balconyShare = random.uniform(0.3, 0.9);
    for (int number = 1; number < building.floors; ++number) {
        const int base = storey(number);
        const bool balcony = style.balconies && facade.role == FacadeRole::front && bays.left(0) >= 5 &&
                             (oneBalcony || bays.pitch - bays.width >= 8) && random.uniform() < balconyShare;
        const int sill = balcony ? 1 : style.sill;
        const DesignRect rail{bays.left(0) - 3, bays.right(bays.count - 1) + 3, base - 1, base + 9};
        if (balcony && oneBalcony) relief(segment, rail, 0.8, 0.85, ReliefKind::balcony);
        for (int i = 0; i < bays.count; ++i) {
            const DesignRect at{bays.left(i), bays.right(i), base + sill,
                                base + style.sill + style.windowHeight};
            const bool painted = inBayWindow(at);
            // Now and then a window was bricked up.
            if (!painted && !balcony && random.uniform() < 0.015) continue;
            facade.openings.push_back(
                {segment, at, painted ? 0.1 : style.recess, OpeningKind::window, look(), painted});
            if (balcony && !oneBalcony) {
                relief(segment, {at.s0 - 3, at.s1 + 3, rail.y0, rail.y1}, 0.8, 0.85, ReliefKind::balcony);
            }
            if (!balcony && !painted && facade.role == FacadeRole::front) {
                relief(segment, {at.s0 - 1, at.s1 + 1, at.y0 - 1, at.y0}, 0.07, 0.06, ReliefKind::sill, true);
            }
        }
    }
}

void Designer::ledges() {
    const BuildingStyle& style = facade.style;
    if (style.wall == WallKind::stone) relief(kAllRound, {0, 0, 0, 3}, 0.06, 0.05, ReliefKind::plinth, true);
    relief(kAllRound, {0, 0, ground - 2, ground}, style.ledgeDepth * 0.7, style.ledgeDepth,
           ReliefKind::ledge);
    if (style.floorLedges) {
        for (int number = 2; number < building.floors; ++number) {
            relief(kAllRound, {0, 0, storey(number) - 1, storey(number) + 1}, 0.06, 0.08, ReliefKind::ledge,
                   true);
        }
    }
    const int roof = upper + 4, wallTop = roof + building.parapetDecimetres;
    const int high = std::min(roof + 2, wallTop - 1);
    relief(kAllRound, {0, 0, high - 4, high - 2}, style.corniceDepth * 0.4, style.corniceDepth * 0.5,
           ReliefKind::cornice, true);
    relief(kAllRound, {0, 0, high - 2, high}, style.corniceDepth, style.corniceDepth, ReliefKind::cornice);
}

void designFront(const Building& b, Facade& facade, std::uint64_t seed) {
    const BuildingStyle& style = facade.style;
    Designer designer{b,
                      facade,
                      Random(seed),
                      b.groundFloorDecimetres,
                      b.floorDecimetres,
                      b.groundFloorDecimetres + (b.floors - 1) * b.floorDecimetres};
    // The first long segment has the house door.
    int main = 0;
    for (int k = 1; k < facade.segments(); ++k) {
        const double here = facade.starts[k + 1] - facade.starts[k],
                     there = facade.starts[main + 1] - facade.starts[main];
        if (here > there) main = k;
    }
    for (int k = 0; k < facade.segments(); ++k) {
        const bool front = facade.role == FacadeRole::front;
        const Bays bays = front ? layBays(facade, k, style.bay, style.windowWidth)
                                : layBays(facade, k, style.bay + 10, std::min(style.windowWidth, 11));
        if (bays.count == 0 || bays.width < 5) continue;
        if (front && style.bayWindows && bays.count > 1) designer.bayWindows(k, bays);
        designer.groundFloor(k, bays, k == main);
        designer.upperFloors(k, bays);
        if (front && style.pilasters && bays.pitch - bays.width >= 8) {
            for (int i = 0; i <= bays.count; ++i) {
                const int middle = bays.left(i) - (bays.pitch - bays.width) / 2;
                if (middle < 4 || middle > bays.length - 4) continue;
                designer.relief(k, {middle - 2, middle + 2, designer.ground + 1, designer.upper - 1}, 0.12,
                                0.12, ReliefKind::pilaster, true);
            }
        }
    }
    if (facade.role == FacadeRole::front) designer.ledges();
    std::stable_sort(facade.reliefs.begin(), facade.reliefs.end(),
                     [](const Relief& a, const Relief& c) { return a.kind < c.kind; });
}

Facade startFacade(const Building& b, const BuildingStyle& style, FacadeRole role, int first, int count) {
    Facade facade;
    facade.role = role;
    facade.style = style;
    facade.top = b.top();
    facade.wrapDown = b.roof == RoofShape::flat ? b.roofY() - 0.15 : b.top() - 0.5;
    facade.seed =
        static_cast<std::uint32_t>(Random::forPart(b.seed, 16 + static_cast<std::uint64_t>(first)).bits());
    setLine(facade, b, first, count);
    facade.flaps = role == FacadeRole::front;
    return facade;
}

}  // namespace

std::vector<Facade> designFacades(const Building& b) {
    const BuildingStyle style = makeStyle(b);
    std::vector<Facade> facades;
    for (const WallUse use : {WallUse::street, WallUse::back}) {
        const FacadeRole role = use == WallUse::street ? FacadeRole::front : FacadeRole::back;
        const auto isUse = [&](int wall) { return b.walls[(wall + 4) % 4] == use; };
        for (int first = 0; first < 4; ++first) {
            if (!isUse(first) || isUse(first - 1)) continue;
            int count = 1;
            while (isUse(first + count)) ++count;
            facades.push_back(startFacade(b, style, role, first, count));
            designFront(b, facades.back(), facades.back().seed);
        }
    }
    for (int wall = 0; wall < 4; ++wall) {
        if (b.walls[wall] != WallUse::party) continue;
        Facade facade = startFacade(b, style, FacadeRole::party, wall, 1);
        facade.bottom = b.wallFrom[wall] > 0.0 ? b.wallFrom[wall] : -0.2;
        if (facade.top - facade.bottom < 0.2) facade.bottom = facade.top - 0.2;
        facades.push_back(std::move(facade));
    }
    for (Facade& facade : facades) facade.baseY = b.baseY;
    return facades;
}

}  // namespace fb::city
