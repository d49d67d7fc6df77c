// Names a block's content and the way it is built, so that a build can tell which packs of an earlier one
// still hold.
#pragma once

#include "import/texture_store.h"
#include "settings/settings.h"

namespace fb {

// Raised whenever the same source and settings give other nodes than before.
inline constexpr std::uint64_t kBuilderVersion = 15;

// Of every knob of the group "build", and of kBuilderVersion.
[[nodiscard]] std::uint64_t hashBuildSettings(const BuildSettings& settings);

// Of meshes, materials and textures; texture files count with what is in them, read once a store.
[[nodiscard]] std::uint64_t hashBlock(const SourceBlock& block, TextureStore& store);

}  // namespace fb
