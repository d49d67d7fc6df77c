#include "import/city_plan.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace fb::city {
namespace {

struct GridSize {
    std::uint64_t columns = 1, rows = 1;
};

// Two units a city block in a small city, so that it has streets inside; up to nearly four in a large one
// (the thesis's has 25 city blocks). About as wide as it is deep.
GridSize chooseGrid(std::uint64_t units) {
    const double wanted = 2.0 + 1.7 * std::clamp((static_cast<double>(units) - 20.0) / 80.0, 0.0, 1.0);
    GridSize best;
    double bestCost = 1e300;
    for (std::uint64_t columns = 1; columns <= units; ++columns) {
        if (columns * columns > 4 * units) break;
        for (std::uint64_t rows = 1; rows * columns <= units; ++rows) {
            const double perCell = static_cast<double>(units) / static_cast<double>(columns * rows);
            if (perCell > 4.0) continue;
            const double width = 58.0 * static_cast<double>(columns),
                         depth = 46.0 * static_cast<double>(rows);
            const double aspect = width > depth ? width / depth : depth / width;
            const double cost = (perCell - wanted) * (perCell - wanted) + 0.25 * (aspect - 1.0);
            if (cost < bestCost) {
                bestCost = cost;
                best = {columns, rows};
            }
        }
    }
    return best;
}

// The streets of one direction with the blocks between them, all in decimetres, the middle near 0.
std::vector<Street> layStreets(Random& random, std::uint64_t blocks, int shortest, int longest, double& end) {
    std::vector<Street> streets;
    std::vector<int> centres;
    int at = 0;
    for (std::uint64_t i = 0; i <= blocks; ++i) {
        constexpr std::array kHalfCarriages{46, 48, 52, 58};
        constexpr std::array kPavements{28, 32, 38};
        const int carriage = kHalfCarriages[random.index(kHalfCarriages.size())];
        const int pavement = kPavements[random.index(kPavements.size())];
        at += carriage + pavement;
        streets.push_back({0.0, carriage / 10.0, pavement / 10.0});
        centres.push_back(at);
        at += carriage + pavement;
        const int block =
            shortest + static_cast<int>(random.index(static_cast<std::uint64_t>(longest - shortest + 1)));
        if (i < blocks) at += block;
    }
    const int middle = at / 2;
    for (std::size_t i = 0; i < streets.size(); ++i) streets[i].centre = (centres[i] - middle) / 10.0;
    end = (at - middle) / 10.0;
    return streets;
}

// The ground of one city block: to the middle of the streets, at the border of the city to their far side.
struct Cell {
    Rect region, block;
    double centrality = 0.0;
};

Cell cellAt(const CityPlan& plan, std::size_t column, std::size_t row) {
    const Street &west = plan.alongZ[column], &east = plan.alongZ[column + 1];
    const Street &north = plan.alongX[row], &south = plan.alongX[row + 1];
    Cell cell;
    cell.block = {west.centre + west.halfWidth(), north.centre + north.halfWidth(),
                  east.centre - east.halfWidth(), south.centre - south.halfWidth()};
    cell.region = {column == 0 ? plan.ground.x0 : west.centre, row == 0 ? plan.ground.z0 : north.centre,
                   column + 1 == plan.columns() ? plan.ground.x1 : east.centre,
                   row + 1 == plan.rows() ? plan.ground.z1 : south.centre};
    const double fromX = std::abs((cell.block.x0 + cell.block.x1) / plan.ground.width());
    const double fromZ = std::abs((cell.block.z0 + cell.block.z1) / plan.ground.depth());
    cell.centrality = 1.0 - std::max(fromX, fromZ);
    return cell;
}

Rect overlap(const Rect& a, const Rect& b) {
    return {std::max(a.x0, b.x0), std::max(a.z0, b.z0), std::min(a.x1, b.x1), std::min(a.z1, b.z1)};
}

void addUnit(CityPlan& plan, const Cell& cell, const Rect& region, std::initializer_list<const Row*> rows,
             bool alley, std::uint32_t cellIndex) {
    Unit unit;
    unit.region = region;
    unit.built = overlap(region, cell.block);
    unit.alley = alley;
    unit.cell = cellIndex;
    unit.seed = Random::forPart(plan.seed, 0x10000 + plan.units.size()).bits();
    for (const Row* row : rows) {
        for (const Building& building : row->buildings) {
            const double middle = (building.footprint.x0 + building.footprint.x1) / 2.0;
            if (middle > region.x0 && middle < region.x1) unit.buildings.push_back(building);
        }
        for (const Rect& park : row->carParks) {
            const double middle = (park.x0 + park.x1) / 2.0;
            if (middle > region.x0 && middle < region.x1) unit.carParks.push_back(park);
        }
    }
    for (const Building& building : unit.buildings) {
        // 3 m: machinery, chimneys and their noise.
        plan.highestTop = std::max(plan.highestTop, building.baseY + building.top() + pitchedRoofHeight(building) + 3.0);
    }
    plan.units.push_back(std::move(unit));
}

// The border between lots nearest to the middle of a row.
double middleEdge(const Row& row) {
    const std::vector<double>& edges = row.lotEdges;
    const double middle = (edges.front() + edges.back()) / 2.0;
    double best = edges[edges.size() / 2];
    for (std::size_t i = 1; i + 1 < edges.size(); ++i) {
        if (std::abs(edges[i] - middle) < std::abs(best - middle)) best = edges[i];
    }
    return best;
}

void fillCell(CityPlan& plan, const Cell& cell, std::uint64_t units, std::uint32_t index) {
    Random random = Random::forPart(plan.seed, 0x100 + index);
    const bool alley = random.uniform() < 0.4;
    const double middle = std::floor((cell.block.z0 + cell.block.z1) * 5.0) / 10.0;
    const double halfAlley = alley ? 2.2 : 0.0;
    const RowPlan northPlan{{cell.block.x0, cell.block.z0, cell.block.x1, middle - halfAlley},
                            false,
                            alley,
                            cell.centrality,
                            random.bits()};
    const RowPlan southPlan{{cell.block.x0, middle + halfAlley, cell.block.x1, cell.block.z1},
                            true,
                            alley,
                            cell.centrality,
                            random.bits()};
    Row north = makeRow(northPlan), south = makeRow(southPlan);
    for (Row* row : {&north, &south}) {
        for (Building& b : row->buildings) {
            const Rect& f = b.footprint;
            b.baseY = plan.hills.within(f.x0, f.z0, f.x1, f.z1).high;
        }
    }
    findSeenWalls(north, south);
    const Rect& all = cell.region;
    if (units == 1) {
        addUnit(plan, cell, all, {&north, &south}, alley, index);
        return;
    }
    const auto addRow = [&](const Row& row, double z0, double z1, bool split) {
        const double x = split ? middleEdge(row) : all.x1;
        addUnit(plan, cell, {all.x0, z0, x, z1}, {&row}, alley, index);
        if (split) addUnit(plan, cell, {x, z0, all.x1, z1}, {&row}, alley, index);
    };
    addRow(north, all.z0, middle, units == 4);
    addRow(south, middle, all.z1, units >= 3);
}

}  // namespace

double pitchedRoofHeight(const Building& building) {
    const double half = std::min(building.footprint.width(), building.footprint.depth()) / 2.0;
    if (building.roof == RoofShape::hip) return half * 0.55;
    if (building.roof == RoofShape::mansard) return 2.6 + std::max(0.0, half - 1.2) * 0.12;
    return 0.0;
}

bool CityPlan::isCarriageway(double x, double z) const {
    const auto inside = [](const std::vector<Street>& streets, double at) {
        return std::any_of(streets.begin(), streets.end(),
                           [at](const Street& s) { return std::abs(at - s.centre) < s.halfCarriage; });
    };
    return inside(alongZ, x) || inside(alongX, z);
}

CityPlan makePlan(const CityOptions& options) {
    CityPlan plan;
    plan.seed = options.seed;
    const GridSize grid = chooseGrid(options.blocks);
    Random random = Random::forPart(options.seed, 0);
    // Smaller blocks for fewer triangles, so that windows still get their share of samples.
    const double perCell =
        static_cast<double>(options.triangles) / static_cast<double>(grid.columns * grid.rows);
    const double scale = std::clamp(std::sqrt(perCell / 180000.0), 0.62, 1.2);
    const int length = static_cast<int>(560.0 * scale);
    plan.alongZ = layStreets(random, grid.columns, length * 8 / 10, length * 12 / 10, plan.ground.x1);
    plan.alongX = layStreets(random, grid.rows, 260, 330, plan.ground.z1);
    plan.ground.x0 = plan.alongZ.front().centre - plan.alongZ.front().halfWidth();
    plan.ground.z0 = plan.alongX.front().centre - plan.alongX.front().halfWidth();

    plan.hills = {options.terrain,  static_cast<std::uint32_t>(options.seed), plan.ground.x0, plan.ground.z0,
                   plan.ground.x1, plan.ground.z1};

    // The remainder goes to cells spread evenly.
    const std::uint64_t cells = grid.columns * grid.rows;
    const std::uint64_t offset = random.index(cells);
    for (std::uint64_t i = 0; i < cells; ++i) {
        const std::uint64_t k = (i + offset) % cells;
        const std::uint64_t units = (k + 1) * options.blocks / cells - k * options.blocks / cells;
        plan.firstUnitOfCell.push_back(static_cast<std::uint32_t>(plan.units.size()));
        fillCell(plan, cellAt(plan, i % grid.columns, i / grid.columns), units,
                 static_cast<std::uint32_t>(i));
    }
    plan.firstUnitOfCell.push_back(static_cast<std::uint32_t>(plan.units.size()));
    return plan;
}

}  // namespace fb::city
