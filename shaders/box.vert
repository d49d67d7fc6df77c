// The twelve edges of a box: 24 line ends from the vertex number, one instance a box.
#version 450 core
#include "frame.glsl"

layout(std430, binding = kBoxBinding) readonly buffer BoxBlock { BoxData boxes[]; };

layout(location = 0) flat out vec3 colour;

void main() {
    int edge = gl_VertexID >> 1, end = gl_VertexID & 1;
    // Edges 0-3 run along x, 4-7 along y, 8-11 along z; the two low bits of the edge choose the other coordinates.
    int axis = edge >> 2;
    bvec2 others = bvec2((edge & 1) != 0, (edge & 2) != 0);
    bvec3 high = axis == 0 ? bvec3(end != 0, others) : axis == 1 ? bvec3(others.x, end != 0, others.y) : bvec3(others, end != 0);
    BoxData box = boxes[gl_InstanceID];
    gl_Position = clipFromRelative(mix(box.low, box.high, high));
    gl_Position.z *= 1.0005;  // a box often touches the surface that it bounds
    colour = box.colour;
}
