// Triangle edges over the surface. Drawn without an index buffer, so that each corner knows which of the three it is:
// the vertex number is the place of an index in the mesh page, and the vertex is fetched from there.
#version 450 core
#extension GL_ARB_shader_draw_parameters : require
#include "frame.glsl"

layout(std430, binding = kDrawBinding) readonly buffer DrawBlock { DrawData draws[]; };
layout(std430, binding = kMeshBinding) readonly buffer MeshBlock { uint words[]; };

layout(location = 0) out vec3 corner;  // barycentric

void main() {
    uint id = uint(gl_BaseInstanceARB);
    uint first = (words[gl_VertexID] + draws[id].baseVertex) * kWordsPerVertex;
    vec3 position = uintBitsToFloat(uvec3(words[first], words[first + 1u], words[first + 2u]));
    precise vec3 onGrid = position + draws[id].coarse;
    precise vec3 relative = onGrid + draws[id].fine;
    gl_Position = clipFromRelative(relative);
    gl_Position.z *= 1.0001;  // nearer by a ten-thousandth of the distance: the edge wins over its own surface
    int c = gl_VertexID % 3;
    corner = vec3(c == 0, c == 1, c == 2);
}
