// Paints the textures of the procedural city: one picture a facade and one picture from above for ground and
// roofs. Row by row, each row as runs of one material, so that the work per texel is a few multiplications.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "import/city_budget.h"
#include "import/city_noise.h"

namespace fb::city {

// `features`: the grid that the mesh was filled from; it ties texels to the wall.
[[nodiscard]] Image paintFacade(const Facade& facade, const FacadeGrid& features, PictureSize size);
// `things`: those that will stand there, for their shadows.
[[nodiscard]] Image paintAerial(const CityPlan& plan, const Unit& unit, std::span<const Thing> things,
                                PictureSize size);

// Texels [begin, end) of a row.
struct Run {
    int begin = 0, end = 0;

    [[nodiscard]] bool empty() const { return begin >= end; }
    [[nodiscard]] Run within(const Run& other) const {
        return {begin > other.begin ? begin : other.begin, end < other.end ? end : other.end};
    }
};

// One row of a picture while it is painted.
struct PaintRow {
    double at = 0.0;                // y on a facade, z on the ground; metres, at the texels' centres
    double texel = 0.05;            // metres
    std::span<const float> places;  // s or x of each column
    std::span<const float> shade;   // around 1: blotches, grain, dirt of the surface at each column
    std::span<const float> wave;    // around 0, in [-1, 1]: smooth noise of about 0.4 m
    std::uint8_t* pixels = nullptr;

    // The columns with places in [low, high).
    [[nodiscard]] Run between(double low, double high) const;
    void put(int column, const Colour& colour, float shade) const;
    void fill(const Run& run, const Colour& colour) const;                // times shade
    void fillPlain(const Run& run, const Colour& colour) const;           // as it is
    void blend(const Run& run, const Colour& colour, float share) const;  // over what is there, times shade
    void darken(const Run& run, float factor) const;
    void multiply(int column, float factor) const;
};

// Courses of bricks, ashlar, panels or boards.
struct MasonryFormat {
    double course = 0.07, unitLength = 0.21, joint = 0.01;  // metres
    float toneSpread = 0.12f;
    bool staggered = true;
};

// A wall of masonry along fixed columns. Joints narrower than a texel take their share of it.
class Masonry {
  public:
    Masonry(const MasonryFormat& format, std::span<const float> columns, double texel, std::uint32_t seed);
    void paint(const PaintRow& row, const Run& run, const Colour& colour, const Colour& joint) const;

  private:
    struct Bond {
        std::vector<int> unitEnd;  // first column after each unit
        std::vector<std::int32_t> unitNumber;
        std::vector<int> unitOfColumn;
        std::vector<float> jointCover;
    };
    MasonryFormat format_;
    double texel_;
    float strength_;  // 0 where units are smaller than texels
    std::uint32_t seed_;
    Bond bonds_[2];
};

// Share of the texel around `at` that joints of `width` around multiples of `period` cover.
[[nodiscard]] float jointCoverAt(double at, double period, double width, double texel);

// Block letters of 3 by 5 cells. Fills those columns of the row that belong to `text`, whose upper left
// corner is at (left, top) with letters of 5 cells' height.
void paintText(const PaintRow& row, std::string_view text, double left, double top, double cell,
               const Colour& colour, float share);
[[nodiscard]] double textWidth(std::string_view text, double cell);
[[nodiscard]] std::string_view signText(std::uint32_t look);

// The texels of an opening: the reveal runs from the outer to the inner run.
struct OpeningRuns {
    Run outer, inner;
};
void paintOpening(const Facade& facade, const Opening& opening, const OpeningRuns& runs, const PaintRow& row);

// Reliefs: those of the wall before the openings, the others over them.
void paintRelief(const Facade& facade, const Relief& relief, const Run& run, const PaintRow& row);

// Streets with their markings, pavements, yards, car parks on one row of the ground; `cracks` is smooth
// noise.
void paintGroundRow(const CityPlan& plan, const Unit& unit, const Masonry& slabs,
                    std::span<const float> cracks, const PaintRow& row);
// The part of a roof on one row, seen from above. `places` of the row are x.
void paintRoofRow(const Building& building, const BuildingStyle& style, const Run& run, const PaintRow& row);
// The columns of the row that lie on a building's footprint, its cut-off corners left out.
[[nodiscard]] Run footprintRun(const Building& building, const PaintRow& row);

// The last step of each row: light (fixed point, 256 is 1, per column and channel) and the grain of the film.
struct LightColumn {
    std::uint16_t r = 256, g = 256, b = 256;
};
void developRow(std::span<const LightColumn> light, std::uint32_t grainSeed, std::uint8_t* pixels);

// Place inside a repeating pattern, 0 to 1.
[[nodiscard]] inline double phase(double at, double period) { return at / period - std::floor(at / period); }

}  // namespace fb::city
