// A facade: one continuous sheet of wall along one or more walls of a building, with everything that stands
// out of it or is set back. One design serves the mesh and the texture, so that a painted window lies in the
// recess of the mesh. Comes from a Building; goes to lines (city_facade_lines), mesh (city_facade_mesh) and
// texture (city_paint_facade).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "import/city_mesh.h"
#include "import/city_style.h"

namespace fb::city {

// Places on a facade: s runs to the right as seen from outside, y up. Designs are in whole decimetres, s from
// the start of its segment, so that two edges are never closer than that.
struct DesignRect {
    int s0 = 0, s1 = 0, y0 = 0, y1 = 0;
};

enum class OpeningKind : std::uint8_t { window, shop, door, garage };

struct Opening {
    int segment = 0;
    DesignRect at;
    double depth = 0.0;  // metres behind the wall around it
    OpeningKind kind = OpeningKind::window;
    std::uint32_t look = 0;  // hash: blinds, reflections, content
    bool painted = false;    // wood panels around it: inside a bay window
};

// In the order in which they cover each other.
enum class ReliefKind : std::uint8_t {
    plinth,
    pilaster,
    ledge,
    cornice,
    bayWindow,
    sill,
    sign,
    balcony,
    awning
};

struct Relief {
    int segment = 0;  // kAllRound: along the whole facade, s0 and s1 unused
    DesignRect at;
    double depthLow = 0.0, depthHigh = 0.0;  // metres in front of the wall, at y0 and y1
    ReliefKind kind = ReliefKind::ledge;
    std::uint32_t look = 0;
    bool fine = false;  // shaped only where the samples are dense; painted always
};
inline constexpr int kAllRound = -1;

enum class FacadeRole : std::uint8_t { front, back, party };

struct Facade {
    FacadeRole role = FacadeRole::front;
    std::vector<glm::dvec2> line;     // corners in plan (x, z), one more than segments
    std::vector<double> starts;       // s of each corner
    std::vector<glm::dvec2> normals;  // outward, one a segment
    bool flaps = false;  // turns a little around both ends, so that no gap opens beside a neighbour
    double bottom = -0.2, top = 0.0;
    double baseY = 0.0;  // of the building: heights are above it
    double wrapDown = 0.0;  // the sheet goes over the parapet and down to here
    std::vector<Opening> openings;
    std::vector<Relief> reliefs;
    BuildingStyle style;
    std::uint32_t seed = 0;

    [[nodiscard]] int segments() const { return static_cast<int>(normals.size()); }
    [[nodiscard]] double length() const { return starts.back(); }
    [[nodiscard]] double areaSquareMetres() const { return length() * (top - bottom); }
};

// All sheets of a building: fronts, backs, bare walls. At least one wall must be of another use than the
// next.
[[nodiscard]] std::vector<Facade> designFacades(const Building& building);

// How much of the design the mesh shows: flat walls, openings and large reliefs, or everything.
enum class Detail : std::uint8_t { flat, coarse, all };

// A grid line of the sheet. Features have a pair of lines 5 cm apart around each edge.
struct GridLine {
    double at = 0.0;         // s or y in metres
    double inset = 0.0;      // metres behind the wall plane: flaps and the way over the parapet
    double textureAt = 0.0;  // metres along the texture: steep steps get more than their projection
    int corner = -1;         // index into Facade::line where the column stands on a corner
};
struct FacadeGrid {
    std::vector<GridLine> columns, rows;

    [[nodiscard]] double textureWidth() const { return columns.back().textureAt; }
    [[nodiscard]] double textureHeight() const { return rows.back().textureAt; }
    [[nodiscard]] std::uint64_t triangles() const { return 2 * (columns.size() - 1) * (rows.size() - 1); }
};

inline constexpr double kHalfStep = 0.025;  // metres from a feature's edge to the lines of its pair

// Lines that the design needs, without filling.
[[nodiscard]] FacadeGrid featureGrid(const Facade& facade, Detail detail);
// Triangles after filling to `spacing` metres, without making the lines.
[[nodiscard]] std::uint64_t countFilled(const FacadeGrid& features, double spacing);
[[nodiscard]] FacadeGrid fillGrid(const FacadeGrid& features, double spacing, std::uint32_t seed);

// Adds the sheet as a scan of the facade: textured with `material` (uvs over the whole texture), or grey.
void addFacade(const Facade& facade, const FacadeGrid& grid, Detail detail, std::uint32_t material,
               bool textured, MeshBuilder& mesh);

}  // namespace fb::city
