#include "base/camera.h"

#include <cmath>
#include <numbers>

namespace fb {

Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    glm::dvec3 forward = target - eye;
    const double length = glm::length(forward);
    forward = length > 1e-12 ? forward / length : glm::dvec3(0.0, 0.0, -1.0);
    glm::dvec3 right = glm::cross(forward, up);
    if (glm::length(right) < 1e-9) {
        right = glm::cross(forward, std::abs(forward.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    }
    right = glm::normalize(right);
    const glm::dmat3 axes(right, glm::cross(right, forward), -forward);
    Camera camera;
    camera.eye = eye;
    camera.orientation = glm::normalize(glm::quat_cast(axes));
    return camera;
}

bool isUsable(const Camera& camera) {
    const glm::dquat& q = camera.orientation;
    const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    bool finite = std::isfinite(camera.fovyRadians) && std::isfinite(camera.nearMetres) && std::isfinite(norm);
    for (int i = 0; i < 3; ++i) finite = finite && std::isfinite(camera.eye[i]);
    const bool opens = camera.fovyRadians > 0.0 && camera.fovyRadians < std::numbers::pi;
    return finite && std::abs(norm - 1.0) < 1e-3 && opens && camera.nearMetres > 0.0;
}

}  // namespace fb
