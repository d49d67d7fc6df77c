// Rows of lots: widths, heights and depths of the buildings, and which of their walls can be seen.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "import/city_plan.h"

namespace fb::city {
namespace {

// A building may stand back from the street by up to 0.4 m; its neighbour's facade turns around the corner
// that far.
constexpr double kSetbackTolerance = 0.45;

std::vector<int> splitIntoLots(Random& random, int lengthDecimetres) {
    std::vector<int> widths;
    int left = lengthDecimetres;
    while (left > 0) {
        const bool corner = widths.empty();
        int width = 72 + static_cast<int>(random.index(80)) + (corner ? 25 : 0);
        if (left - width < 95) width = left > 175 ? left / 2 : left;
        widths.push_back(width);
        left -= width;
    }
    return widths;
}

int drawFloors(Random& random, double centrality) {
    const double u = random.uniform() * (0.72 + 0.34 * centrality);
    constexpr std::array kBelow{0.12, 0.37, 0.61, 0.76, 0.84, 0.90};
    for (std::size_t i = 0; i < kBelow.size(); ++i) {
        if (u < kBelow[i]) return static_cast<int>(i) + 2;
    }
    return 8 + static_cast<int>(random.index(5));
}

struct LotPlace {
    double x0, x1;
    bool west, east;  // at this end of the row
};

Building makeBuilding(Random& random, const RowPlan& row, const LotPlace& lot) {
    Building b;
    b.seed = random.bits();
    const bool corner = lot.west || lot.east;
    b.floors = drawFloors(random, row.centrality);
    if (lot.x1 - lot.x0 < 8.0) b.floors = std::min(b.floors, 5);
    b.shop = random.uniform() < (corner ? 0.85 : 0.65);
    b.groundFloorDecimetres =
        b.shop ? 39 + static_cast<int>(random.index(8)) : 32 + static_cast<int>(random.index(4));
    b.floorDecimetres = 30 + static_cast<int>(random.index(6));
    b.parapetDecimetres = 4 + static_cast<int>(random.index(8));
    const double setback = corner ? 0.0 : static_cast<double>(random.index(5)) / 10.0;
    const double yard = corner ? 0.0 : static_cast<double>(random.index(row.alley ? 3 : 5));
    const bool chamfered = corner && random.uniform() < 0.4;
    const double cut = (18 + static_cast<double>(random.index(12))) / 10.0;
    const double roof = random.uniform();
    if (!chamfered && b.floors <= 5 && roof < 0.24) {
        b.roof = roof < 0.11 ? RoofShape::hip : RoofShape::mansard;
        b.parapetDecimetres = 0;
    }
    b.footprint = {lot.x0, row.area.z0, lot.x1, row.area.z1};
    (row.facesSouth ? b.footprint.z1 : b.footprint.z0) += row.facesSouth ? -setback : setback;
    (row.facesSouth ? b.footprint.z0 : b.footprint.z1) += row.facesSouth ? yard : -yard;
    const int front = row.facesSouth ? kSouth : kNorth, rear = row.facesSouth ? kNorth : kSouth;
    b.walls[front] = WallUse::street;
    b.walls[rear] = WallUse::back;
    b.walls[kWest] = lot.west ? WallUse::street : WallUse::party;
    b.walls[kEast] = lot.east ? WallUse::street : WallUse::party;
    // The corner between walls i and i + 1 belongs to wall i.
    if (chamfered && lot.west) b.chamfer[row.facesSouth ? kWest : kNorth] = cut;
    if (chamfered && lot.east) b.chamfer[row.facesSouth ? kSouth : kEast] = cut;
    return b;
}

// How a wall stands against another building: metres along it that the other covers, and that are left open.
struct Contact {
    double covered = 0.0, open = 0.0;
};

Contact contactOf(const Building& a, int wall, const Building& b) {
    const Rect &p = a.footprint, &q = b.footprint;
    const bool alongX = wall == kSouth || wall == kNorth;
    const double mine = wall == kSouth ? p.z1 : wall == kNorth ? p.z0 : wall == kEast ? p.x1 : p.x0;
    const double theirs = wall == kSouth ? q.z0 : wall == kNorth ? q.z1 : wall == kEast ? q.x0 : q.x1;
    const double p0 = alongX ? p.x0 : p.z0, p1 = alongX ? p.x1 : p.z1;
    const double q0 = alongX ? q.x0 : q.z0, q1 = alongX ? q.x1 : q.z1;
    if (std::abs(mine - theirs) > 0.05) return {0.0, p1 - p0};
    return {std::max(0.0, std::min(p1, q1) - std::max(p0, q0)),
            std::max(0.0, q0 - p0) + std::max(0.0, p1 - q1)};
}

// `first` breaks the tie between two of the same height: exactly one of them has the wall between them.
void seeWall(Building& a, int wall, const Building& b, bool first) {
    const Contact contact = contactOf(a, wall, b);
    if (contact.covered < 0.05) return;
    const bool besideStreet = wall == kEast || wall == kWest;
    if (contact.open > (besideStreet ? kSetbackTolerance : 0.02)) {
        // Windows in a back wall look over a lower or narrower building behind; a sliver of wall has none.
        if (a.walls[wall] == WallUse::back && contact.open > kSetbackTolerance) return;
        a.walls[wall] = WallUse::party;
        a.wallFrom[wall] = 0.0;
        return;
    }
    const double mine = a.baseY + a.top(), theirs = b.baseY + b.top();
    const bool higher = mine > theirs || (first && mine >= theirs);
    a.walls[wall] = higher ? WallUse::party : WallUse::hidden;
    a.wallFrom[wall] = std::max(0.0, b.roofY() - 0.4 + (b.baseY - a.baseY));
}

}  // namespace

Row makeRow(const RowPlan& plan) {
    Random random(plan.seed);
    Row row;
    const int length = static_cast<int>(std::floor((plan.area.x1 - plan.area.x0) * 10.0 + 0.5));
    const std::vector<int> widths = splitIntoLots(random, length);
    int at = 0;
    row.lotEdges.push_back(plan.area.x0);
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const bool last = i + 1 == widths.size();
        at += widths[i];
        const double x0 = row.lotEdges.back(), x1 = last ? plan.area.x1 : plan.area.x0 + at / 10.0;
        row.lotEdges.push_back(x1);
        const bool inner = i > 0 && !last;
        if (inner && row.carParks.empty() && widths.size() >= 4 && random.uniform() < 0.07) {
            row.carParks.push_back({x0, plan.area.z0, x1, plan.area.z1});
        } else {
            row.buildings.push_back(makeBuilding(random, plan, {x0, x1, i == 0, last}));
        }
    }
    return row;
}

void findSeenWalls(Row& north, Row& south) {
    const auto compare = [](Row& row, const Row& other, bool first) {
        const std::vector<Building> as = row.buildings;  // as they were, so that the order does not matter
        for (std::size_t i = 0; i < as.size(); ++i) {
            Building& b = row.buildings[i];
            if (b.walls[kWest] == WallUse::party)
                b.walls[kWest] = WallUse::back;  // unless a neighbour is found
            if (b.walls[kEast] == WallUse::party) b.walls[kEast] = WallUse::back;
            if (i > 0) {
                if (contactOf(b, kWest, as[i - 1]).covered > 0.05) b.walls[kWest] = WallUse::party;
                seeWall(b, kWest, as[i - 1], false);
            }
            if (i + 1 < as.size()) {
                if (contactOf(b, kEast, as[i + 1]).covered > 0.05) b.walls[kEast] = WallUse::party;
                seeWall(b, kEast, as[i + 1], true);
            }
            const int rear = first ? kSouth : kNorth;
            for (const Building& behind : other.buildings) seeWall(b, rear, behind, first);
        }
    };
    const Row northAsBefore = north;
    compare(north, south, true);
    compare(south, northAsBefore, false);
}

}  // namespace fb::city
