// Variants: TEXTURED, LIT, MASK.
#version 450 core
#include "frame.glsl"
#include "light.glsl"

layout(location = 0) in vec3 colour;
#ifdef TEXTURED
layout(location = 1) in vec2 uv;
layout(binding = 0) uniform sampler2D image;
#endif
#ifdef LIT
layout(location = 2) in float lightTerm;
layout(location = 3) in float towards;
#endif

layout(location = 0) out vec4 pixel;

void main() {
    vec3 shown = colour;
#ifdef TEXTURED
    vec4 texel = texture(image, uv);
#ifdef MASK
    if (texel.a < 0.5) discard;
#endif
    shown *= texel.rgb;
#endif
#ifdef LIT
    shown *= brightness(frame.lightConstant, lightTerm, gl_FrontFacing, towards);
#endif
    pixel = vec4(shown, 1.0);
}
