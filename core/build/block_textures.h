// The textures of a block while it is built: of each the tiles that the block's triangles show, in which texels that
// no triangle shows are filled with what lies around them, so that no background bleeds into coarse levels.
// Comes from SourceBlock and TextureStore; goes to make_charts, make_atlas and bake_charts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "build/texture_levels.h"
#include "import/texture_store.h"

namespace fb {

// Texture coordinates beyond this are noise, and repeats could no longer be told apart in single precision.
inline constexpr float kLargestUv = 1e6f;

struct BlockTextures {
    std::vector<std::optional<TextureLevels>>
        textures;               // by SourceBlock::textures; empty: unused or unreadable
    bool losslessFiles = true;  // every used texture was decoded from a lossless file
    std::uint64_t texels = 0;   // of all used textures, shown or not
    std::uint64_t tiles = 0;    // held at full sharpness
    std::vector<std::string> warnings;
};

// Reads what triangles show of the textures. `block` has passed checkBlock().
[[nodiscard]] BlockTextures decodeTextures(const SourceBlock& block, TextureStore& store);

// The same with a store of its own.
[[nodiscard]] BlockTextures decodeTextures(const SourceBlock& block);

}  // namespace fb
