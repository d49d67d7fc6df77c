// Draws source meshes as directly as possible, to hold the renderer against: what policy `full` shows must be
// what the source shows. In: source blocks and a view. Out: the picture. Nothing of the renderer's pools,
// packing or ordering is used; camera, light and sky are the same numbers. Slow: everything is uploaded for
// the one picture and dropped.
#pragma once

#include <filesystem>
#include <span>

#include "base/result.h"
#include "effects/effects.h"
#include "import/source_scene.h"
#include "select/view.h"

namespace fb {

// On the current OpenGL 4.5 context. Normals that are unknown are averaged from the triangles around the
// vertex, weighted by area. Errors: a texture that cannot be loaded, a triangle with an index out of range,
// no memory.
[[nodiscard]] Result<Image> drawSource(const std::filesystem::path& shaderFolder,
                                       std::span<const SourceBlock> blocks, const View& view,
                                       const ActiveEffects& effects, glm::vec3 up);

}  // namespace fb
