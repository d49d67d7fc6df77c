// One texture of a block with its halved versions, and how its colours are taken: filtered into a rectangle of an
// atlas, or at one point. Comes from block_textures; goes to make_atlas and, by PieceSurface, to bake_charts.
#pragma once

#include <vector>

#include "build/tiled_picture.h"

namespace fb {

// levels[0] has the tiles of the texture that the block shows, each further level is half of the one before. 3
// channels, or 4 where a material cuts holes.
struct TextureLevels {
    std::vector<TiledPicture> levels;

    [[nodiscard]] int width() const { return levels[0].width; }
    [[nodiscard]] int height() const { return levels[0].height; }
    [[nodiscard]] bool hasAlpha() const { return levels[0].channels == 4; }
    // The number of the level that stands for `level`: that or the last one; made when it is first asked for.
    [[nodiscard]] int levelFor(int level);
};

// The texture's part under `rect` (in texels of the whole texture), filtered into the target. Where one target texel
// stands for four texels or more along both axes, from a level of which it takes at least two.
void resampleTexture(TextureLevels& texture, const TexelRect& rect, EdgeMode edge, const ResampleTarget& into);

// Colours averaged over squares of about `footprint` texels. The texture must outlive it.
class TextureSampler {
  public:
    TextureSampler(TextureLevels& texture, float footprint);
    // At `uv`, which may repeat. Alpha is 255 where the texture has none.
    [[nodiscard]] glm::vec4 at(const glm::vec2& uv) const;

  private:
    const TextureLevels* texture_;
    std::size_t level_;
    glm::vec2 size_;  // of the whole texture in texels of the level
};

}  // namespace fb
