// The country around the procedural city as a height map and a picture: fields, meadows, woods, and rock
// where it is steep.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "import/city_noise.h"
#include "import/city_plan.h"

namespace fb::city {
namespace {

constexpr std::uint64_t kCountryVersion = 1;  // raise it when the same options give another country
constexpr double kLeastMargin = 240.0, kFinestCell = 2.0;
constexpr std::uint32_t kMostCells = 1400;
constexpr int kTexelsPerCell = 2;
constexpr double kEdgeCells = 2.0;  // the country reaches this far under the city
constexpr double kBeside = 0.06;    // and lies this far below street level beside it

struct Tint {
    double r, g, b;
};
Tint mix(const Tint& a, const Tint& b, double t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}
double smoothBetween(double low, double high, double v) {
    const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

class Country final : public TerrainSource {
  public:
    explicit Country(const CityPlan& plan) : hills_(plan.hills) {
        const Rect& ground = plan.ground;
        const double margin = std::max({kLeastMargin, ground.width(), ground.depth()});
        const double width = ground.width() + 2.0 * margin, depth = ground.depth() + 2.0 * margin;
        double cell = kFinestCell;
        while (std::max(width, depth) / cell > kMostCells) cell *= 2.0;
        info_.name = "country";
        info_.columns = static_cast<std::uint32_t>(std::ceil(width / cell)) + 1;
        info_.rows = static_cast<std::uint32_t>(std::ceil(depth / cell)) + 1;
        info_.cellMetres = glm::dvec2(cell);
        // On whole cells.
        info_.firstSample = {std::floor((ground.x0 - margin) / cell) * cell, 0.0,
                             std::floor((ground.z0 - margin) / cell) * cell};
        info_.drapeWidth = static_cast<int>(info_.columns) * kTexelsPerCell;
        info_.drapeHeight = static_cast<int>(info_.rows) * kTexelsPerCell;
        info_.texelsPerCell = glm::dvec2(kTexelsPerCell);
        info_.drapeFirst = glm::dvec2(kTexelsPerCell / 2.0);
        info_.drapeLossless = false;  // painted, but as large as photographs are
        Hasher hash;
        hash.text("country").number(kCountryVersion).number(std::uint64_t{hills_.seed});
        for (const double edge : {ground.x0, ground.z0, ground.x1, ground.z1}) hash.number(edge);
        info_.sourceHash = hash.digest();
        float low = std::numeric_limits<float>::infinity(), high = -low;
        static_cast<void>(readHeights([&](std::uint32_t, std::span<const float> rows) -> Result<void> {
            for (const float height : rows) {
                if (height == height) low = std::min(low, height), high = std::max(high, height);
            }
            return {};
        }));
        info_.lowestMetres = low;
        info_.highestMetres = high;
    }

    [[nodiscard]] const TerrainInfo& info() const override { return info_; }

    [[nodiscard]] Result<void> readHeights(const TakeHeights& take) const override {
        std::vector<float> row(info_.columns);
        for (std::uint32_t j = 0; j < info_.rows; ++j) {
            for (std::uint32_t i = 0; i < info_.columns; ++i) row[i] = heightAt(xAt(i), zAt(j));
            if (Result<void> taken = take(j, row); !taken) return taken;
        }
        return {};
    }

    [[nodiscard]] Result<void> readDrape(const TakeTexels& take) const override {
        std::vector<std::uint8_t> row(static_cast<std::size_t>(info_.drapeWidth) * 3);
        const double texel = info_.cellMetres.x / kTexelsPerCell;
        for (int v = 0; v < info_.drapeHeight; ++v) {
            const double z = info_.firstSample.z + (v + 0.5 - info_.drapeFirst.y) * texel;
            for (int u = 0; u < info_.drapeWidth; ++u) {
                const double x = info_.firstSample.x + (u + 0.5 - info_.drapeFirst.x) * texel;
                const Tint tint = colourAt(x, z, texel);
                const std::array channels{tint.r, tint.g, tint.b};
                for (std::size_t c = 0; c < 3; ++c) {
                    row[static_cast<std::size_t>(u) * 3 + c] =
                        static_cast<std::uint8_t>(std::clamp(channels[c], 0.0, 254.5) + 0.5);
                }
            }
            if (Result<void> taken = take(static_cast<std::uint32_t>(v), row); !taken) return taken;
        }
        return {};
    }

  private:
    [[nodiscard]] double xAt(std::uint32_t i) const { return info_.firstSample.x + i * info_.cellMetres.x; }
    [[nodiscard]] double zAt(std::uint32_t j) const { return info_.firstSample.z + j * info_.cellMetres.y; }

    // How far inside the city's ground; negative outside.
    [[nodiscard]] double insideCity(double x, double z) const {
        return std::min({x - hills_.x0, hills_.x1 - x, z - hills_.z0, hills_.z1 - z});
    }
    [[nodiscard]] float heightAt(double x, double z) const {
        const double inside = insideCity(x, z), cell = info_.cellMetres.x;
        if (inside > kEdgeCells * cell) return std::numeric_limits<float>::quiet_NaN();
        // A cell that crosses the city's border lies below its ground as a whole.
        const double below = inside > -cell ? kUnderCity : kBeside;
        return static_cast<float>(hills_.heightAt(x, z) - below);
    }

    // Fields are cells of a lattice whose lines wander; each has its crop, some are woods.
    [[nodiscard]] Tint colourAt(double x, double z, double texel) const {
        const std::uint32_t s = hills_.seed + 201;
        const double wx = x + 22.0 * smoothNoise(s, x, z, 160.0),
                     wz = z + 22.0 * smoothNoise(s + 1, x, z, 160.0);
        constexpr double kFieldWide = 95.0, kFieldDeep = 70.0;
        const double fx = std::floor(wx / kFieldWide), fz = std::floor(wz / kFieldDeep);
        const std::uint32_t field =
            latticeHash(s + 2, static_cast<std::int32_t>(fx), static_cast<std::int32_t>(fz));
        constexpr std::array<Tint, 6> kCrops{
            {{126, 138, 70}, {168, 156, 92}, {98, 122, 58}, {146, 128, 88}, {112, 134, 66}, {186, 172, 110}}};
        Tint tint = kCrops[field % kCrops.size()];
        // Furrows along one side of the field, hedges along its edges.
        const double along = (field & 64u) != 0 ? wx : wz;
        const double furrow = 4.0 * texel;
        tint = mix(tint, {tint.r * 0.9, tint.g * 0.9, tint.b * 0.86},
                   std::abs(2.0 * (along / furrow - std::floor(along / furrow)) - 1.0));
        const double edge = std::min({wx - fx * kFieldWide, (fx + 1.0) * kFieldWide - wx,
                                      wz - fz * kFieldDeep, (fz + 1.0) * kFieldDeep - wz});
        tint = mix({70, 88, 44}, tint, smoothBetween(1.2, 3.0, edge));
        const double meadow = smoothNoise(s + 3, x, z, 240.0) + 0.4 * smoothNoise(s + 4, x, z, 60.0);
        const double wild = smoothBetween(0.05, 0.3, meadow);
        const double blotch = smoothNoise(s + 5, x, z, 9.0),
                     grain = signedUnit(latticeHash(s + 6, static_cast<std::int32_t>(std::floor(x / texel)),
                                                    static_cast<std::int32_t>(std::floor(z / texel))));
        tint = mix(tint, {104 + 8 * blotch, 128 + 8 * blotch, 62 + 5 * blotch}, wild);
        const double wood = smoothNoise(s + 7, x, z, 190.0) + 0.3 * smoothNoise(s + 8, x, z, 24.0);
        const Tint trees{48 + 14 * blotch, 72 + 16 * blotch, 36 + 8 * blotch};
        tint = mix(tint, trees, smoothBetween(0.34, 0.42, wood));
        const double step = 3.0;
        const double gx = (hills_.heightAt(x + step, z) - hills_.heightAt(x - step, z)) / (2.0 * step);
        const double gz = (hills_.heightAt(x, z + step) - hills_.heightAt(x, z - step)) / (2.0 * step);
        const double slope = std::sqrt(gx * gx + gz * gz);
        tint = mix(tint, {128 + 12 * blotch, 122 + 12 * blotch, 112 + 11 * blotch},
                   smoothBetween(0.42, 0.6, slope + 0.05 * blotch));
        const double shade = 1.0 + 0.05 * static_cast<double>(grain);
        return {tint.r * shade, tint.g * shade, tint.b * shade};
    }

    Hills hills_;
    TerrainInfo info_;
};

}  // namespace

std::unique_ptr<TerrainSource> makeCountry(const CityPlan& plan) {
    return std::make_unique<Country>(plan);
}

}  // namespace fb::city
