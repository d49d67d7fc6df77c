// Nodes of the front. Variants by definition: TEXTURED, LIT, MASK (texels with alpha < 0.5 are holes), LEVEL (tinted by
// level: the brightness of the surface stays visible).
#version 450 core
#include "frame.glsl"
#include "light.glsl"

layout(location = 0) in vec3 colour;
#ifdef TEXTURED
layout(location = 1) in vec2 uv;
layout(location = 2) flat in uint layer;
layout(binding = 0) uniform sampler2DArray atlases;
#endif
#ifdef LIT
layout(location = 3) in float lightTerm;
layout(location = 5) in float towards;
#endif
#ifdef LEVEL
layout(location = 4) flat in vec3 levelColour;
#endif

layout(location = 0) out vec4 pixel;

void main() {
    vec3 shown = colour;
#ifdef TEXTURED
    vec4 texel = texture(atlases, vec3(uv, float(layer)));
#ifdef MASK
    if (texel.a < 0.5) discard;
#endif
    shown *= texel.rgb;
#endif
#ifdef LEVEL
    shown = levelColour * (0.65 + 0.35 * dot(shown, vec3(0.2126, 0.7152, 0.0722)));
#endif
#ifdef LIT
    shown *= brightness(frame.lightConstant, lightTerm, gl_FrontFacing, towards);
#endif
    pixel = vec4(shown, 1.0);
}
