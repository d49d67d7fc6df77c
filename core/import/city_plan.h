// The procedural city in plan view: streets, the rows of buildings along them, and which of them make up a
// unit (the block of the hierarchy: one side of a city block, as in thesis 3.2, or a whole small one). Comes
// from CityOptions; goes to the facade design and to the ground. x is east, z is south, y is up; metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "import/city.h"
#include "import/city_hills.h"

namespace fb::city {

struct Rect {
    double x0 = 0.0, z0 = 0.0, x1 = 0.0, z1 = 0.0;

    [[nodiscard]] double width() const { return x1 - x0; }
    [[nodiscard]] double depth() const { return z1 - z0; }
    [[nodiscard]] bool contains(double x, double z) const { return x >= x0 && x <= x1 && z >= z0 && z <= z1; }
};

// A straight street of the grid, along z in CityPlan::alongZ and along x in alongX. Kerbs are halfCarriage
// from the centre, walls halfWidth.
struct Street {
    double centre = 0.0;
    double halfCarriage = 0.0;
    double pavement = 0.0;

    [[nodiscard]] double halfWidth() const { return halfCarriage + pavement; }
};

inline constexpr double kPavementHeight = 0.14;

// Walls of a building in this order. Each runs so that a facade's texture goes to the right as seen from
// outside: south to the east, east to the north, north to the west, west to the south.
inline constexpr int kSouth = 0, kEast = 1, kNorth = 2, kWest = 3;

enum class WallUse : std::uint8_t {
    hidden,  // behind a neighbour as high or higher
    party,   // bare wall, seen above a lower neighbour or beside a shallower one
    back,    // windows towards a yard, an alley or a car park
    street,
};

enum class RoofShape : std::uint8_t { flat, hip, mansard };

struct Building {
    Rect footprint;
    std::array<WallUse, 4> walls{};
    std::array<double, 4> wallFrom{};  // height from which the wall can be seen
    std::array<double, 4>
        chamfer{};  // length cut off both walls at the end of each wall; 0 for a sharp corner
    int floors = 1;
    int groundFloorDecimetres = 35, floorDecimetres = 32, parapetDecimetres = 5;
    bool shop = false;
    RoofShape roof = RoofShape::flat;
    double baseY = 0.0;  // of its ground floor: the highest ground of its footprint
    std::uint64_t seed = 0;

    [[nodiscard]] double roofY() const {
        return (groundFloorDecimetres + (floors - 1) * floorDecimetres + 4) / 10.0;
    }
    [[nodiscard]] double top() const { return roofY() + parapetDecimetres / 10.0; }  // of the walls
};

// Height of a pitched roof above top().
[[nodiscard]] double pitchedRoofHeight(const Building& building);

struct Unit {
    Rect region;  // ground that it covers: to the middle of the streets and of the city block
    Rect built;   // the part of the region inside the building lines
    std::vector<Building> buildings;
    std::vector<Rect> carParks;
    bool alley = false;  // a service lane along the middle of the city block, otherwise yards
    std::uint32_t cell = 0;
    std::uint64_t seed = 0;
};

struct CityPlan {
    std::vector<Street> alongZ, alongX;  // from west to east, from north to south
    Rect ground;
    std::vector<Unit> units;                     // by cell; cells by rows from the north west
    std::vector<std::uint32_t> firstUnitOfCell;  // one more than there are cells
    Hills hills;
    double highestTop = 0.0;                     // of all buildings, roofs and what stands on them
    std::uint64_t seed = 0;

    [[nodiscard]] std::size_t columns() const { return alongZ.size() - 1; }
    [[nodiscard]] std::size_t rows() const { return alongX.size() - 1; }
    [[nodiscard]] bool isCarriageway(double x, double z) const;
};

// Options as checked by makeCity.
[[nodiscard]] CityPlan makePlan(const CityOptions& options);

// One row of lots along x, its street to the south or to the north. Lots at both ends have a street at their
// side too.
struct RowPlan {
    Rect area;
    bool facesSouth = true;
    bool alley = false;
    double centrality = 0.0;  // 1 in the middle of the city, 0 at its border: higher buildings
    std::uint64_t seed = 0;
};
struct Row {
    std::vector<Building> buildings;  // from west to east
    std::vector<Rect> carParks;
    std::vector<double> lotEdges;  // x of all lots' borders, both ends included
};
[[nodiscard]] Row makeRow(const RowPlan& plan);

// Decides which walls can be seen, from the neighbours in both rows of a city block.
void findSeenWalls(Row& north, Row& south);

// A walk along the middle of streets around several corners.
[[nodiscard]] WalkHint planWalk(const CityPlan& plan);

}  // namespace fb::city
