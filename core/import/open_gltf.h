// A glTF 2.0 document in memory, from JSON or GLB, parsed by tinygltf after everything has been checked that
// it takes on trust: the chunks of a GLB, the depth of the JSON, sizes of buffers and views, and which files
// may be read. Images are not decoded. Comes from read_gltf.cpp and goes back there.
#pragma once

#include <tiny_gltf.h>

#include <memory>

#include "import/mesh_file.h"

namespace fb {

// Refused: extensions that the file requires and that are not supported, by name in one error.
// Adds the buffer files that were read to `into.otherFiles`.
[[nodiscard]] Result<std::unique_ptr<tinygltf::Model>> openGltf(const MeshBytes& input, MeshFile& into,
                                                                ImportReport& report);

}  // namespace fb
