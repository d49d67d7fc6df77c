// How one building of the procedural city looks: materials, colours, window format, ornaments. Drawn from the
// building's seed; its facades (shape and texture) and its roof follow it.
#pragma once

#include "import/city_plan.h"

namespace fb::city {

// 0 to 255, before light and weather.
struct Colour {
    float r = 0.0f, g = 0.0f, b = 0.0f;

    [[nodiscard]] Colour scaled(float f) const { return {r * f, g * f, b * f}; }
    [[nodiscard]] Colour mixed(const Colour& other, float f) const {
        return {r + (other.r - r) * f, g + (other.g - g) * f, b + (other.b - b) * f};
    }
};

enum class WallKind : std::uint8_t { brick, plaster, stone, panel, siding };

enum class RoofCover : std::uint8_t { gravel, felt, membrane, tiles, slate };

struct BuildingStyle {
    WallKind wall = WallKind::plaster;
    Colour wallColour, jointColour, groundColour, trim, frame, door, accent, blind;
    RoofCover roof = RoofCover::gravel;
    Colour roofColour;
    // Decimetres: bays are the spacing of windows.
    int bay = 25, windowWidth = 12, windowHeight = 17, sill = 9;
    double recess = 0.15;
    int panesAcross = 2, panesDown = 2;
    bool pilasters = false, floorLedges = false, bayWindows = false, balconies = false, awnings = false;
    bool quoins = false, lintels = false, dentils = false;
    double ledgeDepth = 0.15, corniceDepth = 0.4;
    float grime = 0.5f;  // 0 clean, 1 never washed
};

[[nodiscard]] BuildingStyle makeStyle(const Building& building);

}  // namespace fb::city
