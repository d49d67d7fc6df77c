// Source meshes drawn naively, to check the renderer against: plain vertices relative to the eye. Variants: TEXTURED, LIT.
#version 450 core
#include "frame.glsl"

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 textureCoordinate;
layout(location = 3) in vec3 vertexColour;

layout(location = 0) out vec3 colour;
#ifdef TEXTURED
layout(location = 1) out vec2 uv;
#endif
#ifdef LIT
layout(location = 2) out float lightTerm;
layout(location = 3) out float towards;
#endif

void main() {
    gl_Position = clipFromRelative(relative);
    colour = vertexColour;
#ifdef TEXTURED
    uv = textureCoordinate;
#endif
#ifdef LIT
    lightTerm = dot(normal, frame.light);
    towards = -dot(normal, relative);
#endif
}
