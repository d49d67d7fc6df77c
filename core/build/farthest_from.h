// How far one surface lies from another: the one-sided Hausdorff distance, bounded from above.
// Used by measure_error. Branch and bound. Boxes of `from` whose corners all lie close enough to one triangle
// of `to` are done with as a whole, since the distance to a convex set is convex. Other triangles are cut
// along the edges of `to` below them, walking from neighbour to neighbour, so that each part has one face to
// be close to. Where no face below a part is close enough, it is halved until the faces nearest to its
// corners bound it together. (Boxes and halving after Tang, Lee and Kim, "Interactive Hausdorff Distance
// Computation for General Polygonal Models", 2009; the walk is our own.)
#pragma once

#include "build/measured_surface.h"

namespace fb {

// The bound exceeds the distance (or `atLeast`) by no more than about this share and this many grid units;
// the latter also cover rounding of coordinates below 2^24 in float.
inline constexpr double kFarthestRelative = 0.02, kFarthestUnits = 4.0;

// An upper bound of the largest distance of any point of `from` to `to`, never below `atLeast`. Neither is
// empty.
[[nodiscard]] double farthestFrom(const MeasuredSurface& from, const MeasuredSurface& to, double atLeast);

}  // namespace fb
