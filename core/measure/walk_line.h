// The way that the built-in paths walk: a line on the ground (a scene's walk hint, or a way round the scene)
// as a place and a heading by the metres walked, corners rounded. A closed line is walked round and round, an
// open one back and forth. Comes from SceneInfo; goes to the generators of built-in paths.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace fb {

// Two level axes and up, right-handed in the order along, across, up.
struct GroundAxes {
    glm::dvec3 along{1, 0, 0}, across{0, 0, -1}, up{0, 1, 0};
};

class WalkLine {
  public:
    // `points`: at least two different ones, finite. Corners are rounded over `roundingMetres` of way, turns
    // of the heading over `turningMetres`. Good for 0 to `reachMetres`.
    WalkLine(const std::vector<glm::dvec3>& points, const GroundAxes& axes, double reachMetres,
             double roundingMetres, double turningMetres);

    [[nodiscard]] double lengthMetres() const { return lengthMetres_; }  // of the line, walked once

    // The mean of the line over the rounding length around the metre `s`.
    [[nodiscard]] glm::dvec3 placeAt(double s) const;
    // In turns, from `along` towards `across`, without jumps; the mean over the turning length around `s`.
    [[nodiscard]] double headingAt(double s) const;

  private:
    struct Leg {
        glm::dvec3 start, end;
        double startMetres, endMetres;
        double headingTurns;
    };
    template <class T, class Value>
    T meanAround(double s, double windowMetres, T sum, const Value& valueOf) const;

    std::vector<Leg> legs_;
    double lengthMetres_ = 0.0, roundingMetres_, turningMetres_;
};

// Whether the points make a line of at least `minimumMetres`.
[[nodiscard]] bool isWalkable(const std::vector<glm::dvec3>& points, double minimumMetres);

}  // namespace fb
