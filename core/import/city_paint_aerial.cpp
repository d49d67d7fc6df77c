// The picture of a unit from above, with the shadows that buildings and things throw on the ground and on
// lower roofs.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

constexpr double kShadowX = 0.23, kShadowZ = -0.5;  // metres per metre of height: the sun of the facades
constexpr LightColumn kSunlit{264, 258, 246}, kShaded{142, 152, 174};

struct Caster {
    const Building* building;
    double top;
};

// Buildings whose shadow may fall into the unit: of its own city block and the blocks around it.
std::vector<Caster> castersAround(const CityPlan& plan, const Unit& unit) {
    std::vector<Caster> casters;
    const auto columns = static_cast<std::int64_t>(plan.columns()),
               rows = static_cast<std::int64_t>(plan.rows());
    const std::int64_t column = unit.cell % columns, line = unit.cell / columns;
    for (std::int64_t j = std::max<std::int64_t>(0, line - 1); j <= std::min(rows - 1, line + 1); ++j) {
        for (std::int64_t i = std::max<std::int64_t>(0, column - 1); i <= std::min(columns - 1, column + 1);
             ++i) {
            const auto cell = static_cast<std::size_t>(j * columns + i);
            for (std::uint32_t k = plan.firstUnitOfCell[cell]; k < plan.firstUnitOfCell[cell + 1]; ++k) {
                for (const Building& b : plan.units[k].buildings) {
                    casters.push_back({&b, b.top() + pitchedRoofHeight(b) * 0.5});
                }
            }
        }
    }
    return casters;
}

// The columns of the row in the shadow of a rectangle `height` above the surface.
Run shadowRun(const Rect& rect, double height, const PaintRow& row) {
    const double vx = kShadowX * height, vz = kShadowZ * height;
    const double from = std::max(0.0, (row.at - rect.z0) / vz), to = std::min(1.0, (row.at - rect.z1) / vz);
    if (from > to) return {};
    return row.between(rect.x0 + from * vx, rect.x1 + to * vx);
}

class AerialPainter {
  public:
    AerialPainter(const CityPlan& plan, const Unit& unit, std::span<const Thing> things, PictureSize size)
        : plan_(plan),
          unit_(unit),
          things_(things),
          size_(size),
          columns_(makeColumns()),
          texel_(unit.region.width() / size.width),
          casters_(castersAround(plan, unit)),
          // World coordinates and the city's seed: the ground goes on unbroken from unit to unit.
          large_(columns_, 7.3, seed(1)),
          waves_(columns_, 0.6, seed(2)),
          fine_(columns_, 0.14, seed(3)),
          cracks_(columns_, 2.1, seed(4)),
          slabs_({1.2, 1.2, 0.025, 0.06f, false}, columns_, texel_, seed(5)),
          shade_(columns_.size()),
          wave_(columns_.size()),
          crack_(columns_.size()),
          light_(columns_.size()) {
        for (const Building& b : unit.buildings) styles_.push_back(makeStyle(b));
    }

    Image paint() {
        Image image;
        image.width = size_.width;
        image.height = size_.height;
        image.channels = 3;
        image.lossless = true;
        image.pixels.resize(size_.texels() * 3);
        const Rect& region = unit_.region;
        for (int j = 0; j < size_.height; ++j) {
            std::uint8_t* pixels = image.pixels.data() + static_cast<std::size_t>(j) * size_.width * 3;
            paintRow(region.z0 + (j + 0.5) * region.depth() / size_.height, pixels);
            developRow(
                light_,
                seed(6) + static_cast<std::uint32_t>(unit_.seed) + 977u * static_cast<std::uint32_t>(j),
                pixels);
        }
        return image;
    }

  private:
    std::uint32_t seed(std::uint32_t part) const {
        return mixBits(static_cast<std::uint32_t>(plan_.seed) * 31u + part);
    }

    std::vector<float> makeColumns() const {
        std::vector<float> columns;
        for (int i = 0; i < size_.width; ++i) {
            columns.push_back(
                static_cast<float>(unit_.region.x0 + (i + 0.5) * unit_.region.width() / size_.width));
        }
        return columns;
    }

    void shadeRow(double z) {
        std::fill(shade_.begin(), shade_.end(), 1.0f);
        std::fill(wave_.begin(), wave_.end(), 0.0f);
        std::fill(crack_.begin(), crack_.end(), 0.0f);
        waves_.addRow(z, 1.0f, wave_);
        cracks_.addRow(z, 1.0f, crack_);
        large_.addRow(z, 0.10f, shade_);
        if (texel_ < 0.15) fine_.addRow(z, 0.08f, shade_);
        for (std::size_t i = 0; i < shade_.size(); ++i) shade_[i] += 0.04f * wave_[i];
    }

    void setShade(const Run& run) {
        for (int i = run.begin; i < run.end; ++i) light_[i] = kShaded;
    }

    void castOn(double surfaceY, const Run& within, const Building* own, const PaintRow& row) {
        for (const Caster& caster : casters_) {
            const double height = caster.top - surfaceY;
            if (caster.building == own || height < 0.4) continue;
            setShade(shadowRun(caster.building->footprint, height, row).within(within));
        }
    }

    void castThings(const PaintRow& row) {
        for (const Thing& thing : things_) {
            for (const Lump& lump : thing) {
                const double halfX = lump.size.x / 2.0, halfZ = lump.size.z / 2.0;
                if (lump.shape != LumpShape::ball) {
                    setShade(shadowRun(
                        {lump.base.x - halfX, lump.base.z - halfZ, lump.base.x + halfX, lump.base.z + halfZ},
                        lump.size.y, row));
                    continue;
                }
                const double height = lump.base.y + lump.size.y / 2.0;
                const double dz = (row.at - (lump.base.z + kShadowZ * height)) / halfZ;
                if (dz * dz >= 1.0) continue;
                const double half = halfX * std::sqrt(1.0 - dz * dz), x = lump.base.x + kShadowX * height;
                setShade(row.between(x - half, x + half));
            }
        }
    }

    void paintRow(double z, std::uint8_t* pixels) {
        shadeRow(z);
        std::fill(light_.begin(), light_.end(), kSunlit);
        const PaintRow row{z, texel_, columns_, shade_, wave_, pixels};
        paintGroundRow(plan_, unit_, slabs_, crack_, row);
        castOn(0.0, {0, size_.width}, nullptr, row);
        for (std::size_t i = 0; i < unit_.buildings.size(); ++i) {
            const Building& building = unit_.buildings[i];
            const Run run = footprintRun(building, row);
            if (run.empty()) continue;
            paintRoofRow(building, styles_[i], run, row);
            std::fill(light_.begin() + run.begin, light_.begin() + run.end, kSunlit);
            castOn(building.roofY(), run, &building, row);
        }
        castThings(row);
    }

    const CityPlan& plan_;
    const Unit& unit_;
    std::span<const Thing> things_;
    PictureSize size_;
    std::vector<float> columns_;
    double texel_;
    std::vector<Caster> casters_;
    std::vector<BuildingStyle> styles_;
    NoiseOctave large_, waves_, fine_, cracks_;
    Masonry slabs_;
    std::vector<float> shade_, wave_, crack_;
    std::vector<LightColumn> light_;
};

}  // namespace

Image paintAerial(const CityPlan& plan, const Unit& unit, std::span<const Thing> things, PictureSize size) {
    return AerialPainter(plan, unit, things, size).paint();
}

}  // namespace fb::city
