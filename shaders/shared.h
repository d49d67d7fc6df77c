// The structs and numbers that C++ writes and GLSL reads; included by both, so that they are written once.
// Layout: every vec3 is followed by a 4-byte member, sizes are multiples of 16, which std140, std430 and C++ lay out
// alike (held by static_assert in core/draw/frame_data.cpp).
#ifndef FB_SHADERS_SHARED_H
#define FB_SHADERS_SHARED_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace fb::gpu {
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

const uint kFrameBinding = 0u;  // uniform buffer: FrameData
const uint kDrawBinding = 1u;   // storage buffer: DrawData, one a draw
const uint kBoxBinding = 2u;    // storage buffer: BoxData, one a box
const uint kMeshBinding = 3u;   // storage buffer: the words of a mesh page, for the wireframe

const uint kWordsPerVertex = 6u;  // GpuVertex: 3 position, 1 normal, 1 texture coordinates, 1 colour

// All directions in scene axes; positions are metres relative to the eye.
struct FrameData {
    vec3 clipX;  // clip.x = dot(clipX, p): the camera's right times the scale of the picture
    float nearMetres;
    vec3 clipY;
    float lightConstant;  // brightness of a surface whose normal is at right angles to `light`
    vec3 clipW;           // the camera's forward: clip.w is the depth in metres
    float unused0;
    vec3 light;  // brightness = lightConstant + dot(normal towards the viewer, light)
    float unused1;
    vec3 skyRight;  // the direction of the pixel at (x, y) in [-1, 1] is clipW + x * skyRight + y * skyUp
    float unused2;
    vec3 skyUp;
    float unused3;
    vec3 up;  // of the scene
    float unused4;
};

// One draw: the part of a node that one program draws. A vertex relative to the eye is (position + coarse) + fine,
// added up in this order (see splitTranslation).
struct DrawData {
    vec3 coarse;
    uint layer;  // in the texture array
    vec3 fine;
    uint baseVertex;
    vec3 levelColour;
    uint unused;
};

struct BoxData {
    vec3 low;  // corners relative to the eye
    float unused0;
    vec3 high;
    float unused1;
    vec3 colour;
    float unused2;
};

#ifdef __cplusplus
}  // namespace fb::gpu
#endif
#endif
