#version 450 core
#include "frame.glsl"

layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 pixel;

void main() {
    float height = dot(direction, frame.up) * inversesqrt(dot(direction, direction));
    const vec3 zenith = vec3(0.35, 0.53, 0.78), horizon = vec3(0.80, 0.87, 0.93), ground = vec3(0.47, 0.48, 0.48);
    vec3 above = mix(horizon, zenith, sqrt(max(height, 0.0)));
    pixel = vec4(mix(above, ground, clamp(-height * 12.0, 0.0, 1.0)), 1.0);
}
