// The camera: from metres relative to the eye to clip space. Depth is reversed and infinite: depth = near / distance.
#include "shared.h"

layout(std140, binding = kFrameBinding) uniform FrameBlock { FrameData frame; };

vec4 clipFromRelative(vec3 p) { return vec4(dot(frame.clipX, p), dot(frame.clipY, p), frame.nearMetres, dot(frame.clipW, p)); }
