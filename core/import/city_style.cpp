#include "import/city_style.h"

#include <span>

#include "base/random.h"

namespace fb::city {
namespace {

constexpr std::array kBricks{Colour{142, 78, 60},   Colour{120, 66, 54}, Colour{158, 102, 74},
                             Colour{172, 140, 104}, Colour{108, 76, 66}, Colour{150, 88, 72}};
constexpr std::array kPlasters{Colour{214, 203, 178}, Colour{200, 172, 126}, Colour{190, 188, 184},
                               Colour{196, 150, 128}, Colour{176, 186, 170}, Colour{222, 219, 212},
                               Colour{170, 152, 132}, Colour{160, 172, 184}};
constexpr std::array kStones{Colour{182, 172, 152}, Colour{166, 162, 156}, Colour{194, 182, 156},
                             Colour{150, 142, 134}};
constexpr std::array kPanels{Colour{168, 166, 160}, Colour{186, 178, 166}, Colour{148, 150, 152}};
constexpr std::array kSidings{Colour{190, 200, 204}, Colour{150, 170, 160}, Colour{206, 196, 160},
                              Colour{128, 142, 160}, Colour{216, 214, 206}};
constexpr std::array kFrames{Colour{226, 224, 218}, Colour{70, 58, 48}, Colour{44, 46, 50},
                             Colour{150, 152, 154}, Colour{58, 84, 70}};
constexpr std::array kAccents{Colour{150, 34, 36},  Colour{26, 74, 52},  Colour{30, 52, 104},
                              Colour{196, 148, 40}, Colour{60, 60, 62},  Colour{170, 86, 34},
                              Colour{96, 40, 84},   Colour{34, 110, 120}};
constexpr std::array kRoofs{Colour{150, 146, 138}, Colour{84, 84, 86}, Colour{196, 196, 192},
                            Colour{150, 84, 58}, Colour{92, 98, 106}};

Colour drawColour(Random& random, std::span<const Colour> palette, double spread) {
    const Colour base = palette[random.index(palette.size())];
    const double light = random.uniform(1.0 - spread, 1.0 + spread);
    const auto channel = [&](float value) {
        return static_cast<float>(value * light * random.uniform(1.0 - spread / 3.0, 1.0 + spread / 3.0));
    };
    return {channel(base.r), channel(base.g), channel(base.b)};
}

int between(Random& random, int low, int high) {
    return low + static_cast<int>(random.index(static_cast<std::uint64_t>(high - low + 1)));
}

void chooseWall(Random& random, const Building& building, BuildingStyle& style) {
    const double u = random.uniform();
    if (building.floors >= 7) {
        style.wall = u < 0.3 ? WallKind::brick : u < 0.6 ? WallKind::stone : WallKind::panel;
    } else if (building.floors <= 3 && u < 0.2) {
        style.wall = WallKind::siding;
    } else {
        style.wall = u < 0.48 ? WallKind::brick : u < 0.8 ? WallKind::plaster : WallKind::stone;
    }
    switch (style.wall) {
        case WallKind::brick:
            style.wallColour = drawColour(random, kBricks, 0.12);
            style.jointColour = style.wallColour.mixed({188, 182, 170}, 0.55f);
            style.lintels = true;
            break;
        case WallKind::plaster:
            style.wallColour = drawColour(random, kPlasters, 0.07);
            style.lintels = random.uniform() < 0.5;
            break;
        case WallKind::stone:
            style.wallColour = drawColour(random, kStones, 0.07);
            style.jointColour = style.wallColour.scaled(0.72f);
            style.lintels = random.uniform() < 0.4;
            break;
        case WallKind::panel:
            style.wallColour = drawColour(random, kPanels, 0.06);
            style.jointColour = style.wallColour.scaled(0.5f);
            break;
        case WallKind::siding:
            style.wallColour = drawColour(random, kSidings, 0.06);
            style.jointColour = style.wallColour.scaled(0.66f);
            style.lintels = true;
            break;
    }
}

void chooseWindows(Random& random, const Building& building, BuildingStyle& style) {
    const int roomAbove = building.floorDecimetres - 4;
    if (style.wall == WallKind::panel) {
        // Office bands: wide windows close together.
        style.bay = between(random, 20, 30);
        style.windowWidth = style.bay - between(random, 4, 7);
        style.windowHeight = between(random, 15, 19);
        style.sill = between(random, 7, 9);
        style.panesAcross = between(random, 1, 3);
        style.panesDown = 1;
        style.recess = random.uniform(0.08, 0.2);
    } else {
        style.bay = between(random, 21, 31);
        style.windowWidth = between(random, 10, 14);
        style.windowHeight = between(random, 15, 20);
        style.sill = between(random, 6, 9);
        style.panesAcross = between(random, 1, 2);
        style.panesDown = between(random, 2, 3);
        style.recess = random.uniform(0.12, 0.26);
    }
    if (style.sill + style.windowHeight > roomAbove) style.windowHeight = roomAbove - style.sill;
}

}  // namespace

BuildingStyle makeStyle(const Building& building) {
    Random random = Random::forPart(building.seed, 1);
    BuildingStyle style;
    chooseWall(random, building, style);
    chooseWindows(random, building, style);
    const bool plain = style.wall == WallKind::panel || style.wall == WallKind::siding;
    const bool light = random.uniform() < 0.6;
    style.trim = light ? Colour{212, 204, 188} : style.wallColour.scaled(0.78f);
    style.trim = style.trim.scaled(static_cast<float>(random.uniform(0.86, 1.04)));
    style.groundColour = random.uniform() < 0.5 ? style.wallColour : style.trim.mixed(style.wallColour, 0.3f);
    style.frame = drawColour(random, kFrames, 0.08);
    style.door = drawColour(random, kAccents, 0.2);
    style.accent = drawColour(random, kAccents, 0.15);
    style.blind = Colour{206, 200, 186}.scaled(static_cast<float>(random.uniform(0.8, 1.1)));
    style.pilasters = !plain && random.uniform() < 0.3;
    style.floorLedges = !plain && random.uniform() < 0.4;
    style.bayWindows = style.wall != WallKind::panel && building.floors >= 3 && building.floors <= 6 &&
                       random.uniform() < 0.35;
    style.balconies = !style.bayWindows && !plain && random.uniform() < 0.3;
    style.awnings = building.shop && random.uniform() < 0.45;
    style.quoins = !plain && !style.pilasters && random.uniform() < 0.35;
    style.dentils = !plain && random.uniform() < 0.5;
    style.ledgeDepth = random.uniform(0.08, 0.25);
    style.corniceDepth = plain ? random.uniform(0.05, 0.2) : random.uniform(0.25, 0.65);
    style.grime = static_cast<float>(random.uniform(0.25, 1.0));
    if (building.roof == RoofShape::flat) {
        style.roof = static_cast<RoofCover>(random.index(3));
    } else {
        style.roof =
            building.roof == RoofShape::hip && random.uniform() < 0.7 ? RoofCover::tiles : RoofCover::slate;
    }
    style.roofColour =
        kRoofs[static_cast<std::size_t>(style.roof)].scaled(static_cast<float>(random.uniform(0.82, 1.12)));
    return style;
}

}  // namespace fb::city
