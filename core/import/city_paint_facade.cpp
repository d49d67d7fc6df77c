#include <algorithm>
#include <cmath>
#include <optional>

#include "import/city_paint.h"

namespace fb::city {
namespace {

// The place on the wall of each texel's centre along one axis; around flaps and over the parapet it simply
// goes on.
std::vector<float> placesOf(const std::vector<GridLine>& lines, int texels) {
    std::size_t first = 0, last = lines.size() - 1;
    while (lines[first].inset > 0.0) ++first;
    while (lines[last].inset > 0.0) --last;
    std::vector<float> places;
    places.reserve(static_cast<std::size_t>(texels));
    const double scale = lines.back().textureAt / texels;
    std::size_t k = first + 1;
    for (int i = 0; i < texels; ++i) {
        const double at = (i + 0.5) * scale;
        while (k < last && lines[k].textureAt < at) ++k;
        const GridLine &a = lines[k - 1], &b = lines[k];
        const double t = (at - a.textureAt) / (b.textureAt - a.textureAt);
        const bool beyond = at < lines[first].textureAt || at > lines[last].textureAt;
        const GridLine& end = at < lines[first].textureAt ? lines[first] : lines[last];
        places.push_back(static_cast<float>(beyond ? end.at + at - end.textureAt : a.at + (b.at - a.at) * t));
    }
    return places;
}

std::optional<MasonryFormat> masonryOf(const BuildingStyle& style) {
    switch (style.wall) {
        case WallKind::brick:
            return MasonryFormat{0.07, 0.21, 0.012, 0.16f, true};
        case WallKind::stone:
            return MasonryFormat{0.38, 0.76, 0.015, 0.07f, true};
        case WallKind::panel:
            return MasonryFormat{1.6, 0.1 * style.bay, 0.02, 0.05f, false};
        case WallKind::siding:
            return MasonryFormat{0.14, 3.3, 0.02, 0.04f, true};
        case WallKind::plaster:
            return std::nullopt;
    }
    return std::nullopt;
}

// Sun from the south-southwest; walls away from it get the blue light of the sky.
LightColumn lightOf(const glm::dvec2& normal, double exposure) {
    const double sun = std::max(0.0, normal.x * -0.42 + normal.y * 0.9);
    const auto fixed = [&](double sky, double direct) {
        return static_cast<std::uint16_t>((sky + direct * sun) * exposure * 256.0);
    };
    return {fixed(0.84, 0.26), fixed(0.87, 0.2), fixed(0.92, 0.1)};
}

// The camera's exposure changes a little from photograph to photograph, every 7 m or so.
std::vector<LightColumn> lightColumns(const Facade& facade, std::span<const float> places) {
    std::vector<LightColumn> light;
    light.reserve(places.size());
    int segment = 0;
    for (const float s : places) {
        while (segment + 1 < facade.segments() && facade.starts[segment + 1] <= s) ++segment;
        const double exposure = 1.0 + 0.05 * smoothNoise(facade.seed + 11, s, 0.0, 6.0);
        light.push_back(lightOf(facade.normals[segment], exposure));
    }
    return light;
}

struct PlacedOpening {
    const Opening* opening;
    OpeningRuns runs;
    double low, high;  // y with the reveals
};

struct PlacedRelief {
    const Relief* relief;
    Run run;
};

class FacadePainter {
  public:
    FacadePainter(const Facade& facade, const FacadeGrid& features, PictureSize size)
        : facade_(facade),
          size_(size),
          columns_(placesOf(features.columns, size.width)),
          rows_(placesOf(features.rows, size.height)),
          texel_(features.textureWidth() / size.width),
          light_(lightColumns(facade, columns_)),
          blotches_(columns_, 2.6, facade.seed + 20),
          waves_(columns_, 0.42, facade.seed + 21),
          grains_(columns_, 0.09, facade.seed + 22),
          shade_(columns_.size()),
          wave_(columns_.size()),
          streaks_(columns_.size()) {
        std::reverse(rows_.begin(), rows_.end());  // row 0 of the picture is at the top
        if (const auto format = masonryOf(facade.style))
            masonry_.emplace(*format, columns_, texel_, facade.seed + 23);
        NoiseOctave narrow(columns_, 0.11, facade.seed + 24), wide(columns_, 0.7, facade.seed + 25);
        narrow.addRow(0.0, 0.5f, streaks_);
        wide.addRow(0.0, 0.6f, streaks_);
        for (float& streak : streaks_) streak = std::max(0.0f, streak + 0.1f);
        placeFeatures();
    }

    Image paint() {
        Image image;
        image.width = size_.width;
        image.height = size_.height;
        image.channels = 3;
        image.lossless = true;
        image.pixels.resize(size_.texels() * 3);
        for (int j = 0; j < size_.height; ++j) {
            std::uint8_t* pixels = image.pixels.data() + static_cast<std::size_t>(j) * size_.width * 3;
            paintRow(rows_[j], pixels);
            developRow(light_, facade_.seed + 977u * static_cast<std::uint32_t>(j), pixels);
        }
        return image;
    }

  private:
    void placeFeatures() {
        PaintRow row;
        row.places = columns_;
        for (const Opening& o : facade_.openings) {
            const double s0 = facade_.starts[o.segment] + o.at.s0 / 10.0,
                         s1 = facade_.starts[o.segment] + o.at.s1 / 10.0;
            placed_.push_back(
                {&o,
                 {row.between(s0 - kHalfStep, s1 + kHalfStep), row.between(s0 + kHalfStep, s1 - kHalfStep)},
                 o.at.y0 / 10.0 - kHalfStep,
                 o.at.y1 / 10.0 + kHalfStep});
        }
        std::stable_sort(placed_.begin(), placed_.end(), [](const PlacedOpening& a, const PlacedOpening& b) {
            return a.runs.outer.begin < b.runs.outer.begin;
        });
        for (const Relief& r : facade_.reliefs) {
            Run run{0, size_.width};
            if (r.segment != kAllRound) {
                const double start = facade_.starts[r.segment];
                run = row.between(start + r.at.s0 / 10.0 - kHalfStep, start + r.at.s1 / 10.0 + kHalfStep);
            }
            reliefs_.push_back({&r, run});
        }
    }

    // Dirt that runs down from ledges and splashes up from the pavement, and the shadow right under ledges.
    void weatherAt(double y, float& stain, float& shadow) const {
        stain = 0.0f;
        shadow = 1.0f;
        const auto below = [&](double edge, double depth) {
            const double d = edge - y;
            if (d < 0.0) return;
            const double run = std::max(0.0, 1.0 - d / 2.4);
            stain = std::max(stain, static_cast<float>(run * run));
            const double reach = 0.08 + 1.1 * depth;
            if (d < reach) shadow = std::min(shadow, static_cast<float>(0.58 + 0.42 * d / reach));
        };
        for (const PlacedRelief& placed : reliefs_) {
            const Relief& r = *placed.relief;
            if (r.segment == kAllRound && r.kind != ReliefKind::plinth) below(r.at.y0 / 10.0, r.depthLow);
        }
        if (facade_.role != FacadeRole::front) below(facade_.top, 0.05);
        const double splash = std::clamp(1.0 - (y - kPavementHeight) / 0.8, 0.0, 1.0);
        if (facade_.bottom < 0.0) stain = std::max(stain, static_cast<float>(splash * splash));
    }

    void shadeRow(double y) {
        const float grime = facade_.style.grime;
        float stain = 0.0f, shadow = 1.0f;
        weatherAt(y, stain, shadow);
        std::fill(shade_.begin(), shade_.end(), shadow - 0.12f * stain * grime);
        std::fill(wave_.begin(), wave_.end(), 0.0f);
        waves_.addRow(y, 1.0f, wave_);
        blotches_.addRow(y, 0.05f + 0.07f * grime, shade_);
        if (texel_ < 0.09) grains_.addRow(y, 0.05f, shade_);
        const float run = 0.34f * stain * grime;
        for (std::size_t i = 0; i < shade_.size(); ++i) shade_[i] += 0.035f * wave_[i] - run * streaks_[i];
    }

    void paintWall(const PaintRow& row, const Run& run) const {
        if (run.empty()) return;
        const BuildingStyle& style = facade_.style;
        if (row.at > facade_.top && row.at < facade_.top + 0.3) {  // the coping of the parapet
            row.fill(run, style.trim.scaled(0.82f));
            return;
        }
        const bool ground =
            facade_.role == FacadeRole::front && !facade_.reliefs.empty() && row.at < groundTop();
        if (ground && style.groundColour.r != style.wallColour.r) {
            row.fill(run, style.groundColour);
        } else if (masonry_) {
            masonry_->paint(row, run, style.wallColour, style.jointColour);
        } else {
            row.fill(run, style.wallColour);
        }
    }

    double groundTop() const {
        for (const PlacedRelief& r : reliefs_) {
            if (r.relief->kind == ReliefKind::ledge && r.relief->segment == kAllRound)
                return r.relief->at.y0 / 10.0;
        }
        return 0.0;
    }

    void paintQuoins(const PaintRow& row) const {
        if (!facade_.style.quoins || facade_.role != FacadeRole::front) return;
        const auto stone = static_cast<int>(std::floor(row.at / 0.36));
        const double length = (stone & 1) != 0 ? 0.62 : 0.4;
        const Colour colour =
            facade_.style.trim.scaled(jointCoverAt(row.at, 0.36, 0.02, texel_) > 0.3f ? 0.72f : 0.94f);
        for (int k = 0; k < facade_.segments(); ++k) {
            row.fill(row.between(facade_.starts[k], facade_.starts[k] + length), colour);
            row.fill(row.between(facade_.starts[k + 1] - length, facade_.starts[k + 1] + 1e-3), colour);
        }
    }

    void paintGhostSign(const PaintRow& row) const {
        if (facade_.role != FacadeRole::party || (facade_.seed & 3u) != 0) return;
        const std::string_view text = signText(facade_.seed >> 4);
        const double cell = std::min(0.34, facade_.length() * 0.7 / textWidth(text, 1.0));
        const double height = facade_.top - facade_.bottom,
                     left = (facade_.length() - textWidth(text, cell)) / 2.0;
        if (height < 5.0 * cell + 1.6) return;
        const double top = facade_.top - 1.2;
        if (row.at < top + cell && row.at > top - 6.0 * cell) {
            row.blend(row.between(left - cell, facade_.length() - left + cell),
                      facade_.style.accent.scaled(0.6f), 0.45f);
        }
        paintText(row, text, left, top, cell, {222, 214, 190}, 0.5f);
    }

    void paintRow(double y, std::uint8_t* pixels) {
        shadeRow(y);
        PaintRow row{y, texel_, columns_, shade_, wave_, pixels};
        // Wall only where no opening will cover it.
        int at = 0;
        for (const PlacedOpening& o : placed_) {
            if (y <= o.low || y >= o.high) continue;
            paintWall(row, {at, o.runs.outer.begin});
            at = std::max(at, o.runs.outer.end);
        }
        paintWall(row, {at, size_.width});
        paintQuoins(row);
        paintGhostSign(row);
        for (const PlacedRelief& r : reliefs_) {
            if (r.relief->kind < ReliefKind::balcony) paintRelief(facade_, *r.relief, r.run, row);
        }
        for (const PlacedOpening& o : placed_) {
            if (facade_.style.lintels && o.opening->kind == OpeningKind::window && !o.opening->painted &&
                y > o.high && y < o.high + 0.18) {
                const Run wider{std::max(0, o.runs.outer.begin - static_cast<int>(0.12 / texel_)),
                                std::min(size_.width, o.runs.outer.end + static_cast<int>(0.12 / texel_))};
                row.fill(wider, facade_.style.trim.scaled(0.92f));
            }
            if (y > o.low && y < o.high) paintOpening(facade_, *o.opening, o.runs, row);
        }
        for (const PlacedRelief& r : reliefs_) {
            if (r.relief->kind >= ReliefKind::balcony) paintRelief(facade_, *r.relief, r.run, row);
        }
    }

    const Facade& facade_;
    PictureSize size_;
    std::vector<float> columns_, rows_;
    double texel_;
    std::vector<LightColumn> light_;
    NoiseOctave blotches_, waves_, grains_;
    std::vector<float> shade_, wave_, streaks_;
    std::optional<Masonry> masonry_;
    std::vector<PlacedOpening> placed_;
    std::vector<PlacedRelief> reliefs_;
};

}  // namespace

Image paintFacade(const Facade& facade, const FacadeGrid& features, PictureSize size) {
    return FacadePainter(facade, features, size).paint();
}

}  // namespace fb::city
