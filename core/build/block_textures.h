// The textures of a block while it is built: each decoded once, texels that no triangle shows filled with
// what lies around them (so that no background bleeds into coarse levels), and halved versions for coarse
// sampling. Comes from SourceBlock; goes to make_charts, fill_atlas and bake_charts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "build/block_mesh.h"
#include "build/resample_image.h"

namespace fb {

// levels[0] is the texture, each further one half of the one before. 3 channels, or 4 where a material cuts
// holes.
struct TextureLevels {
    std::vector<Image> levels;

    [[nodiscard]] int width() const { return levels[0].width; }
    [[nodiscard]] int height() const { return levels[0].height; }
    [[nodiscard]] bool hasAlpha() const { return levels[0].channels == 4; }
    // Level `level` or the last one, made when it is first asked for.
    [[nodiscard]] const Image& level(int level);
};

struct BlockTextures {
    std::vector<std::optional<TextureLevels>>
        textures;               // by SourceBlock::textures; empty: unused or unreadable
    bool losslessFiles = true;  // every used texture was decoded from a lossless file
    std::uint64_t texels = 0;   // of all used textures
    std::vector<std::string> warnings;
};

// Decodes the textures that triangles use.
[[nodiscard]] BlockTextures decodeTextures(const SourceBlock& block);

// Marks the texels that the triangles touch and fills the others.
void fillUnusedTexels(BlockTextures& textures, const BlockMesh& mesh,
                      std::span<const MeshTriangle> triangles);

// The texture's colour at `uv`, which may repeat, averaged over squares of about `footprint` texels. Alpha is
// 255 where the texture has none.
[[nodiscard]] glm::vec4 sampleTexture(TextureLevels& texture, const glm::vec2& uv, float footprint);

}  // namespace fb
