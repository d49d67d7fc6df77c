#include "select/view.h"

#include <algorithm>
#include <cmath>

namespace fb {

View makeView(const Camera& camera, const glm::dvec3& velocity, int width, int height) {
    View view;
    view.camera = camera;
    view.forward = camera.forward();
    view.velocity = velocity;
    view.width = std::max(width, 1);
    view.height = std::max(height, 1);
    const double tanY = std::tan(0.5 * camera.fovyRadians);
    const double tanX = tanY * view.width / view.height;
    view.pixelsPerUnit = 0.5 * view.height / tanY;

    const glm::dvec3 f = view.forward;
    const glm::dvec3 r = camera.right();
    const glm::dvec3 u = camera.up();
    // The plane through the eye that contains the left edge of the picture, and so on.
    const std::array<glm::dvec3, 4> normals = {r + f * tanX, -r + f * tanX, u + f * tanY, -u + f * tanY};
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 n = glm::normalize(normals[i]);
        view.planes[i] = glm::dvec4(n, -glm::dot(n, camera.eye));
    }
    view.planes[4] = glm::dvec4(f, -glm::dot(f, camera.eye) - camera.nearMetres);
    return view;
}

double outsideDistance(const View& view, const Box3f& box) {
    double outside = 0.0;
    for (const glm::dvec4& plane : view.planes) {
        // The corner of the box farthest along the normal: if even that one is behind, all of the box is.
        const glm::dvec3 corner(plane.x >= 0.0 ? box.max.x : box.min.x, plane.y >= 0.0 ? box.max.y : box.min.y,
                                plane.z >= 0.0 ? box.max.z : box.min.z);
        outside = std::max(outside, -(glm::dot(glm::dvec3(plane), corner) + plane.w));
    }
    return outside;
}

}  // namespace fb
