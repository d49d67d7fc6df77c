// CameraPath::at and velocityAt. The eye follows the centripetal Catmull-Rom spline (Yuksel, Schaefer, Keyser
// 2011: no loops and no cusps within a segment) C(s), whose knots are apart by the square root of the
// distance. How fast it is run through is s(t), a monotone cubic through the keys' times (Fritsch and Butland
// 1984): the velocity has no jumps at keys, the eye never runs backwards, and it comes to rest at a key that
// is repeated.
// + - * / and square roots only, so that a path gives the same cameras on every machine.
#include <algorithm>
#include <cmath>

#include "measure/camera_path.h"
#include "measure/slerp_by_halving.h"

namespace fb {
namespace {

double knotDistance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = b - a;
    return std::sqrt(std::sqrt(glm::dot(d, d)));
}

// Between keys `from` and from + 1; nothing moves there where the second is a cut.
struct Segment {
    glm::dvec3 start, end;
    glm::dvec3 startTangent, endTangent;  // dC/ds
    double knots = 0.0;                   // s runs from 0 to here; 0 where the eye rests
    double seconds = 1.0;
    double startRate = 0.0, endRate = 0.0;  // ds/dt
};

// Slope of s(t) at a key between two intervals: 0 where either does not move, else their weighted harmonic
// mean.
double rateBetween(double secondsBefore, double knotsBefore, double secondsAfter, double knotsAfter) {
    if (knotsBefore == 0.0 || knotsAfter == 0.0) return 0.0;
    const double weightBefore = 2.0 * secondsAfter + secondsBefore,
                 weightAfter = secondsAfter + 2.0 * secondsBefore;
    return (weightBefore + weightAfter) /
           (weightBefore * secondsBefore / knotsBefore + weightAfter * secondsAfter / knotsAfter);
}

// dC/ds at p1 of the spline through p0, p1, p2 with knots `before` and `after` apart.
glm::dvec3 tangentAt(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2, double before,
                     double after) {
    return (p1 - p0) / before - (p2 - p0) / (before + after) + (p2 - p1) / after;
}

Segment segmentFrom(const std::vector<PathKey>& keys, std::size_t from) {
    const PathKey &a = keys[from], &b = keys[from + 1];
    Segment segment;
    segment.start = a.camera.eye;
    segment.end = b.camera.eye;
    segment.seconds = b.timeSeconds - a.timeSeconds;
    segment.knots = knotDistance(segment.start, segment.end);
    if (segment.knots == 0.0) return segment;

    // Beyond a cut or the end the spline goes on straight, at the rate of this segment.
    segment.startTangent = segment.endTangent = (segment.end - segment.start) / segment.knots;
    segment.startRate = segment.endRate = segment.knots / segment.seconds;
    if (from > 0 && !a.cut) {
        const PathKey& before = keys[from - 1];
        const double knots = knotDistance(before.camera.eye, segment.start);
        segment.startRate =
            rateBetween(a.timeSeconds - before.timeSeconds, knots, segment.seconds, segment.knots);
        if (knots > 0.0) {
            segment.startTangent =
                tangentAt(before.camera.eye, segment.start, segment.end, knots, segment.knots);
        }
    }
    if (from + 2 < keys.size() && !keys[from + 2].cut) {
        const PathKey& after = keys[from + 2];
        const double knots = knotDistance(segment.end, after.camera.eye);
        segment.endRate =
            rateBetween(segment.seconds, segment.knots, after.timeSeconds - b.timeSeconds, knots);
        if (knots > 0.0) {
            segment.endTangent =
                tangentAt(segment.start, segment.end, after.camera.eye, segment.knots, knots);
        }
    }
    return segment;
}

// The cubic with the given ends and slopes over [0, 1], and its slope.
template <class T>
T cubic(const T& start, const T& startSlope, const T& end, const T& endSlope, double u) {
    const double v = 1.0 - u;
    return start * (v * v * (1.0 + 2.0 * u)) + startSlope * (v * v * u) + end * (u * u * (3.0 - 2.0 * u)) -
           endSlope * (u * u * v);
}
template <class T>
T cubicSlope(const T& start, const T& startSlope, const T& end, const T& endSlope, double u) {
    return (end - start) * (6.0 * u * (1.0 - u)) + startSlope * ((1.0 - u) * (1.0 - 3.0 * u)) +
           endSlope * (u * (3.0 * u - 2.0));
}

// s / knots, in [0, 1], at the fraction `u` of the segment's time.
double knotFraction(const Segment& segment, double u) {
    const double s =
        cubic(0.0, segment.startRate * segment.seconds, segment.knots, segment.endRate * segment.seconds, u);
    return std::clamp(s / segment.knots, 0.0, 1.0);
}

glm::dvec3 eyeAt(const Segment& segment, double u) {
    if (segment.knots == 0.0) return segment.start;
    return cubic(segment.start, segment.startTangent * segment.knots, segment.end,
                 segment.endTangent * segment.knots, knotFraction(segment, u));
}

glm::dvec3 velocityOf(const Segment& segment, double u) {
    if (segment.knots == 0.0) return glm::dvec3(0.0);
    const double rate = cubicSlope(0.0, segment.startRate * segment.seconds, segment.knots,
                                   segment.endRate * segment.seconds, u) /
                        segment.seconds;
    const glm::dvec3 tangent = cubicSlope(segment.start, segment.startTangent * segment.knots, segment.end,
                                          segment.endTangent * segment.knots, knotFraction(segment, u)) /
                               segment.knots;
    return tangent * rate;
}

// The last key at or before the time; the time lies within the path.
std::size_t keyBefore(const std::vector<PathKey>& keys, double timeSeconds) {
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), timeSeconds,
                         [](double time, const PathKey& key) { return time < key.timeSeconds; });
    return static_cast<std::size_t>(after - keys.begin()) - 1;
}

}  // namespace

Camera CameraPath::at(double timeSeconds) const {
    if (keys.empty()) return {};
    if (!(timeSeconds > keys.front().timeSeconds)) return keys.front().camera;
    if (timeSeconds >= keys.back().timeSeconds) return keys.back().camera;
    const std::size_t from = keyBefore(keys, timeSeconds);
    const Camera &a = keys[from].camera, &b = keys[from + 1].camera;
    if (keys[from + 1].cut || timeSeconds == keys[from].timeSeconds) return a;

    const Segment segment = segmentFrom(keys, from);
    const double u = (timeSeconds - keys[from].timeSeconds) / segment.seconds;
    Camera camera;
    camera.eye = eyeAt(segment, u);
    camera.orientation = slerpByHalving(a.orientation, b.orientation, u);
    camera.fovyRadians = a.fovyRadians + (b.fovyRadians - a.fovyRadians) * u;
    camera.nearMetres = a.nearMetres + (b.nearMetres - a.nearMetres) * u;
    return camera;
}

glm::dvec3 CameraPath::velocityAt(double timeSeconds) const {
    const bool within =
        !keys.empty() && timeSeconds >= keys.front().timeSeconds && timeSeconds < keys.back().timeSeconds;
    if (!within) return glm::dvec3(0.0);
    const std::size_t from = keyBefore(keys, timeSeconds);
    const bool atCut = keys[from].cut && timeSeconds == keys[from].timeSeconds;
    if (atCut || keys[from + 1].cut) return glm::dvec3(0.0);
    const Segment segment = segmentFrom(keys, from);
    return velocityOf(segment, (timeSeconds - keys[from].timeSeconds) / segment.seconds);
}

}  // namespace fb
