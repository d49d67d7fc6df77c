// The parts of cleanMesh (import_files.h) that the import needs by themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/import_files.h"

namespace fb {

// cleanMesh, which also tells which triangles it kept: kept[new] = old, ascending.
[[nodiscard]] Result<void> cleanMesh(SourceMesh& mesh, const std::string& what, ImportReport& report,
                                     std::vector<std::uint32_t>& kept);

// Gives every vertex whose normal is (0,0,0) the mean, weighted by area, of the triangles at its position:
// vertices at one position get one normal, so that seams of texture or colour do not show in the shading.
// Where the triangles cancel out (sheets with two sides), the first triangle's. Normals that are there stay.
void addMissingNormals(SourceMesh& mesh);

}  // namespace fb
