// The triangles of one node with all that the node stores of them, before they become vertices and an atlas.
// Comes from simplify_level (or, for leaves, straight from the cut original); goes to make_charts and
// finish_node. Where seams were welded, a triangle takes the attributes of one chart of the original if its
// corners have one in common and the original agrees between them; else it gets texels of its own
// (bake_charts) or, untextured, colours.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "build/block_mesh.h"
#include "build/block_textures.h"
#include "build/piece_surface.h"
#include "build/simplify_level.h"

namespace fb {

struct NodeTriangle {
    glm::uvec3 positions;
    glm::uvec3 wedges{kNone};          // kNone: not taken from the original's corners
    std::uint32_t surface = 0;         // 0 when baked
    bool baked = false;                // gets texels of its own
    bool skirt = false;                // hangs from a border: see skirts.h
    std::array<glm::vec3, 3> normals;  // unit
    std::array<glm::u8vec4, 3> colours;
    std::uint32_t chart = kNone;        // set by make_charts; kNone: untextured
    std::array<glm::vec2, 3> texels{};  // atlas texels from the corner of the chart; then of the atlas
};

// A leaf's triangles: all of the piece as it is.
[[nodiscard]] std::vector<NodeTriangle> dressOriginal(const BlockMesh& mesh,
                                                      std::span<const MeshTriangle> piece);

// A simplified piece whose seams were kept. `scratch` has one kNone per position, and has them again
// afterwards.
[[nodiscard]] std::vector<NodeTriangle> dressSeamed(const BlockMesh& mesh,
                                                    std::span<const MeshTriangle> piece,
                                                    const SimplifiedPiece& simplified,
                                                    std::vector<std::uint32_t>& scratch);

// A simplified piece whose seams were welded. `chartOfWedge` from chartsOfWedges() of the level; `texelScale`
// is the factor by which the node's texture is smaller than the original along each axis.
struct WeldedDress {
    const BlockMesh& mesh;
    std::span<const MeshTriangle> piece;
    const PieceSurface& surface;
    const BlockTextures& textures;
    const std::vector<std::uint32_t>& chartOfWedge;
    double texelScale = 1.0;
};
[[nodiscard]] std::vector<NodeTriangle> dressWelded(const WeldedDress& dress,
                                                    const SimplifiedPiece& simplified,
                                                    std::vector<std::uint32_t>& scratch);

// A number per wedge, equal for wedges that triangles connect.
[[nodiscard]] std::vector<std::uint32_t> chartsOfWedges(const BlockMesh& mesh,
                                                        std::span<const MeshTriangle> triangles);

}  // namespace fb
