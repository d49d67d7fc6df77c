#version 450 core

layout(location = 0) in vec3 corner;
layout(location = 0) out vec4 pixel;

void main() {
    vec3 alongX = dFdx(corner), alongY = dFdy(corner);
    vec3 perPixel = max(sqrt(alongX * alongX + alongY * alongY), vec3(1e-6));
    vec3 distancePixels = corner / perPixel;
    float nearest = min(distancePixels.x, min(distancePixels.y, distancePixels.z));
    // A triangle with a height of few pixels would be nothing but edge: its edges fade.
    float heightPixels = 1.0 / max(perPixel.x, max(perPixel.y, perPixel.z));
    float strength = 0.85 * clamp(heightPixels / 8.0, 0.2, 1.0);
    float cover = (1.0 - smoothstep(0.35, 1.1, nearest)) * strength;
    if (cover < 0.01) discard;
    pixel = vec4(0.03, 0.04, 0.07, cover);
}
