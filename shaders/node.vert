// Nodes of the front. Variants by definition: TEXTURED, LIT, LEVEL (MASK concerns the fragments).
#version 450 core
#extension GL_ARB_shader_draw_parameters : require
#include "frame.glsl"
#include "light.glsl"

layout(std430, binding = kDrawBinding) readonly buffer DrawBlock { DrawData draws[]; };

layout(location = 0) in vec3 position;  // relative to the block's grid origin
layout(location = 1) in vec2 octahedralNormal;
layout(location = 2) in vec2 textureCoordinate;
layout(location = 3) in vec4 vertexColour;

layout(location = 0) out vec3 colour;
#ifdef TEXTURED
layout(location = 1) out vec2 uv;
layout(location = 2) flat out uint layer;
#endif
#ifdef LIT
layout(location = 3) out float lightTerm;
layout(location = 5) out float towards;
#endif
#ifdef LEVEL
layout(location = 4) flat out vec3 levelColour;
#endif

void main() {
    uint id = uint(gl_BaseInstanceARB);
    precise vec3 onGrid = position + draws[id].coarse;
    precise vec3 relative = onGrid + draws[id].fine;
    gl_Position = clipFromRelative(relative);
    colour = vertexColour.rgb;
#ifdef TEXTURED
    uv = textureCoordinate;
    layer = draws[id].layer;
#endif
#ifdef LIT
    vec3 normal = decodeOctahedral(octahedralNormal);
    lightTerm = dot(normal, frame.light);
    towards = -dot(normal, relative);
#endif
#ifdef LEVEL
    levelColour = draws[id].levelColour;
#endif
}
