// Sine and cosine by + * / alone, and the angle of a direction by them and a square root. The functions of C
// libraries may differ in the last place; built-in camera paths decide which nodes are drawn and must be the
// same numbers on every machine. Angles are in turns: 1 is the full circle. Off by less than 1e-15.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace fb {

// (cos, sin) of `turns`, which is finite.
[[nodiscard]] inline glm::dvec2 circlePoint(double turns) {
    const double fraction = turns - std::floor(turns);
    const double quarters = std::floor(4.0 * fraction + 0.5);
    const double a = 2.0 * std::numbers::pi * (fraction - quarters / 4.0);  // |a| <= pi/4
    const double aa = a * a;
    double sine = 1.0, cosine = 1.0;
    // Taylor in Horner's form; the first term left out is below 1e-18.
    for (int k = 8; k >= 1; --k) {
        sine = 1.0 - sine * aa / ((2.0 * k) * (2.0 * k + 1.0));
        cosine = 1.0 - cosine * aa / ((2.0 * k - 1.0) * (2.0 * k));
    }
    sine *= a;
    switch (static_cast<int>(quarters) % 4) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

[[nodiscard]] inline double sinTurns(double turns) {
    return circlePoint(turns).y;
}

// The angle of a direction that is not (0, 0), in [-1/2, 1/2] turns.
[[nodiscard]] inline double turnsOf(const glm::dvec2& direction) {
    const glm::dvec2 d = direction / std::sqrt(glm::dot(direction, direction));
    // An eighth of a turn too coarse at most; each step of Newton's kind then takes the error to a sixth of
    // its cube.
    double turns = std::abs(d.x) >= std::abs(d.y) ? (d.x >= 0.0 ? 0.0 : 0.5) : (d.y >= 0.0 ? 0.25 : -0.25);
    for (int step = 0; step < 5; ++step) {
        const glm::dvec2 c = circlePoint(turns);
        turns += (c.x * d.y - c.y * d.x) / (2.0 * std::numbers::pi);
    }
    return turns > 0.5 ? turns - 1.0 : turns;
}

}  // namespace fb
