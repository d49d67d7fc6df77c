#include "draw/frame_data.h"

#include <cmath>
#include <cstddef>

namespace fb {

using gpu::BoxData;
using gpu::DrawData;
using gpu::FrameData;

// std140 and std430 put a vec3 at a multiple of 16 bytes and the scalar after it into its last 4 bytes.
static_assert(sizeof(FrameData) == 112);
static_assert(offsetof(FrameData, clipX) == 0 && offsetof(FrameData, nearMetres) == 12);
static_assert(offsetof(FrameData, clipY) == 16 && offsetof(FrameData, lightConstant) == 28);
static_assert(offsetof(FrameData, clipW) == 32 && offsetof(FrameData, light) == 48);
static_assert(offsetof(FrameData, skyRight) == 64 && offsetof(FrameData, skyUp) == 80);
static_assert(offsetof(FrameData, up) == 96);
static_assert(sizeof(DrawData) == 48);
static_assert(offsetof(DrawData, coarse) == 0 && offsetof(DrawData, layer) == 12);
static_assert(offsetof(DrawData, fine) == 16 && offsetof(DrawData, baseVertex) == 28);
static_assert(offsetof(DrawData, levelColour) == 32);
static_assert(sizeof(BoxData) == 48);
static_assert(offsetof(BoxData, low) == 0 && offsetof(BoxData, high) == 16 &&
              offsetof(BoxData, colour) == 32);

FrameData frameData(const View& view, const glm::vec3& up) {
    const Camera& camera = view.camera;
    const double width = view.width < 1 ? 1.0 : view.width, height = view.height < 1 ? 1.0 : view.height;
    const double tangent = std::tan(camera.fovyRadians / 2.0);
    const double aspect = width / height;
    const glm::dvec3 right = camera.right(), upward = camera.up(), forward = camera.forward();
    const double upLength = glm::length(glm::dvec3(up));
    const glm::dvec3 sceneUp =
        upLength > 1e-9 && std::isfinite(upLength) ? glm::dvec3(up) / upLength : glm::dvec3(0, 1, 0);

    // A lamp above the viewer's left shoulder and a sky above a darker ground: a surface that faces the
    // viewer is close to full brightness, and neither the shaded side of a head nor the side wall of a street
    // is black.
    const glm::dvec3 lamp = glm::normalize(-forward + 0.35 * upward - 0.3 * right);
    const glm::dvec3 light = 0.34 * lamp + 0.12 * sceneUp;

    FrameData frame{};
    frame.clipX = glm::vec3(right / (tangent * aspect));
    frame.clipY = glm::vec3(upward / tangent);
    frame.clipW = glm::vec3(forward);
    frame.nearMetres = static_cast<float>(camera.nearMetres);
    frame.lightConstant = 0.64f;
    frame.light = glm::vec3(light);
    frame.skyRight = glm::vec3(right * (tangent * aspect));
    frame.skyUp = glm::vec3(upward * tangent);
    frame.up = glm::vec3(sceneUp);
    return frame;
}

SplitTranslation splitTranslation(const glm::dvec3& origin, const glm::dvec3& eye) {
    const glm::dvec3 translation = origin - eye;
    SplitTranslation split;
    split.coarse = glm::vec3(translation);
    split.fine = glm::vec3(translation - glm::dvec3(split.coarse));
    return split;
}

}  // namespace fb
