// Makes winding agree with normals. In: a decoded node. Out: its indices, two of them swapped in each
// triangle whose corner normals point to the side that its winding calls the back. The light asks which side
// of a surface is seen (gl_FrontFacing); models with mirrored parts would be lit inside out.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenefile/node_data.h"

namespace fb {

// Writes content.indices.size() 32-bit indices, which need not be aligned. Every index must be in range.
// `normals` is scratch.
void orientTriangles(const DecodedNode& content, std::vector<glm::vec3>& normals, std::uint8_t* into);

}  // namespace fb
