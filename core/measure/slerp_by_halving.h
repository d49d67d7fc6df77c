// The shortest-arc slerp of two unit quaternions without sines: the middle of an arc is its normalised
// chord's middle, so the arc is halved towards t ten times; what is left is at most a thousandth of a right
// angle, where the normalised chord is the arc to 1e-10. Square roots are rounded alike on every machine,
// sines are not.
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace fb {

[[nodiscard]] inline glm::dquat normalisedQuat(const glm::dquat& q) {
    return q * (1.0 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w));
}

// t in [0, 1].
[[nodiscard]] inline glm::dquat slerpByHalving(glm::dquat from, glm::dquat to, double t) {
    if (t <= 0.0) return from;
    if (t >= 1.0) return to;
    if (from.x * to.x + from.y * to.y + from.z * to.z + from.w * to.w < 0.0) to = -to;
    for (int halving = 0; halving < 10; ++halving) {
        const glm::dquat middle = normalisedQuat(from + to);
        t *= 2.0;
        if (t < 1.0) {
            to = middle;
        } else {
            from = middle;
            t -= 1.0;
        }
    }
    return normalisedQuat(from * (1.0 - t) + to * t);
}

}  // namespace fb
