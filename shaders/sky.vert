// One triangle over the whole picture at infinite distance (reversed depth 0): only pixels that nothing covers pass.
#version 450 core
#include "frame.glsl"

layout(location = 0) out vec3 direction;

void main() {
    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(at, 0.0, 1.0);
    direction = frame.clipW + at.x * frame.skyRight + at.y * frame.skyUp;
}
