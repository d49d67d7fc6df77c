// A random small world for the policies of algorithms 2.1 and 3: random settings, and from frame to frame
// another camera, other residency, other times. About half of what is in view fits the target.
#pragma once

#include "base/random.h"
#include "worlds/tiny_walk.h"

namespace fb {

struct RandomWalk {
    Random r;
    TinyWalk walk;
    TimeModel time;
    View elsewhere;  // where the camera goes back to now and then
    bool comesToRest = false;  // the camera stands still from the sixth frame on, and frames take long
    double leafTriangles = 1.0;
    double unitMs = 1.0;  // of all times: some walks are so fast that a refinement takes microseconds

    RandomWalk(std::uint64_t seed, PolicyId policy);
    SelectInput next();  // of the next frame; stays valid until the call after it
};

}  // namespace fb
