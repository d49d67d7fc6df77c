// The text of an OBJ file as numbers and names, without interpretation. Comes from read_obj.cpp and goes back
// there. An own parser: the common library reads a coordinate that is missing or no number as 0, only warns
// of indices out of range, and loses triangles of concave polygons.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "import/mesh_file.h"

namespace fb {

struct ObjText {
    static constexpr std::uint32_t kAbsent = ~std::uint32_t{0};

    struct Corner {
        std::uint32_t position = kAbsent, uv = kAbsent,
                      normal = kAbsent;  // from 0; not held against the counts
    };
    struct Face {
        std::uint64_t firstCorner = 0;  // the face's corners reach to the next face's
        std::uint32_t material = kAbsent, group = 0;
        std::uint64_t line = 0;
    };

    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> colours;  // as in the file; empty, or one a position with x < 0 for none
    std::vector<glm::vec2> uvs;      // turned to our convention: v from the top
    std::vector<glm::vec3> normals;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    std::vector<std::string> materialNames, groupNames;
    std::vector<std::string> materialLibraries;  // the lines after mtllib, in order
};

// Counts lines and points as ignored and warns of lines that OBJ does not have.
[[nodiscard]] Result<ObjText> parseObjText(const MeshBytes& input, ImportReport& report);

}  // namespace fb
