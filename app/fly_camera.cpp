#include "app/fly_camera.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

constexpr double kWheelFactor = 1.25;
constexpr double kSlowest = 1e-6;  // m/s
constexpr double kFastest = 1e8;

void turn(Camera& camera, double angle, const glm::dvec3& axis) {
    camera.orientation = glm::normalize(glm::angleAxis(angle, axis) * camera.orientation);
}

void look(FlyCamera& c, const glm::dvec2& angle) {
    // A rolled camera turns around its own axis: there is no horizon to keep.
    const bool level = std::abs(glm::dot(c.camera.right(), c.up)) < 1e-3;
    turn(c.camera, -angle.x, level ? c.up : c.camera.up());
    const double pitch = std::asin(std::clamp(glm::dot(c.camera.forward(), c.up), -1.0, 1.0));
    constexpr double kSteepest = 1.55;  // just short of straight up, where looking right would turn over
    const double change = level ? std::clamp(pitch + angle.y, -kSteepest, kSteepest) - pitch : angle.y;
    turn(c.camera, change, c.camera.right());
}

void orbit(FlyCamera& c, const glm::dvec2& angle) {
    const glm::dvec3 before = glm::inverse(c.camera.orientation) * (c.camera.eye - c.pivot);
    look(c, angle);
    c.camera.eye = c.pivot + c.camera.orientation * before;
}

}  // namespace

bool fly(FlyCamera& c, const FlyInput& input, double dtSeconds) {
    c.speedMetresPerSecond =
        std::clamp(c.speedMetresPerSecond * std::pow(kWheelFactor, input.wheel), kSlowest, kFastest);
    const glm::dvec3 start = c.camera.eye;
    const bool moved = input.move != glm::dvec3(0.0);
    const bool turned = input.look != glm::dvec2(0.0) || input.roll != 0.0;
    const bool dragged = input.orbit != glm::dvec2(0.0) || input.pan != glm::dvec2(0.0);
    if (input.look != glm::dvec2(0.0)) look(c, input.look);
    if (input.roll != 0.0) turn(c.camera, input.roll, c.camera.forward());
    if (input.orbit != glm::dvec2(0.0)) orbit(c, input.orbit);
    if (moved) {
        const double step = c.speedMetresPerSecond * dtSeconds;
        c.camera.eye += step * (input.move.x * c.camera.right() + input.move.y * c.camera.up() +
                                input.move.z * c.camera.forward());
    }
    if (input.pan != glm::dvec2(0.0)) {
        const double height = 2.0 * glm::length(c.pivot - c.camera.eye) * std::tan(0.5 * c.camera.fovyRadians);
        const glm::dvec3 shift = height * (-input.pan.x * c.camera.right() + input.pan.y * c.camera.up());
        c.camera.eye += shift;
        c.pivot += shift;
    }
    c.velocity = dtSeconds > 0.0 ? (c.camera.eye - start) / dtSeconds : glm::dvec3(0.0);
    return moved || turned || dragged;
}

void frameBounds(FlyCamera& c, const Box3d& bounds) {
    const double radius = std::max(0.5 * bounds.diagonal(), 1e-6);
    const glm::dvec3 side = std::abs(c.up.z) > 0.5 ? glm::dvec3(0.35, -1.0, 0.0) : glm::dvec3(0.35, 0.0, 1.0);
    const glm::dvec3 direction = glm::normalize(glm::normalize(side) + 0.5 * c.up);
    const double distance = radius / std::sin(0.5 * c.camera.fovyRadians);
    const Camera framed = lookAt(bounds.centre() + distance * direction, bounds.centre(), c.up);
    c.camera.eye = framed.eye;
    c.camera.orientation = framed.orientation;
    c.pivot = bounds.centre();
    c.velocity = glm::dvec3(0.0);
    c.speedMetresPerSecond = 0.25 * radius;
}

}  // namespace fb
