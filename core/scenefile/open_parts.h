// The parts of a scene folder, each opened and verified for itself: openScene() stops at the first that is
// wrong, checkScene() reports all of them.
#pragma once

#include <filesystem>

#include "scenefile/hierarchy_file.h"
#include "scenefile/pack_format.h"
#include "scenefile/scene_toml.h"

namespace fb {

struct OpenedHierarchy {
    HierarchyFile file;
    std::uint64_t hash = 0;  // of the whole of hierarchy.bin
};

[[nodiscard]] Result<void> checkSceneFolder(const std::filesystem::path& folder);
[[nodiscard]] Result<SceneToml> readSceneToml(const std::filesystem::path& folder);
[[nodiscard]] Result<OpenedHierarchy> readHierarchy(const std::filesystem::path& folder);
// An error when the two were not written together.
[[nodiscard]] Result<void> checkBelongTogether(const std::filesystem::path& folder, const SceneToml& toml,
                                               const OpenedHierarchy& hierarchy);
// The pack's length and seal must be those that hierarchy.bin was written with.
[[nodiscard]] Result<FileReader> openPack(const std::filesystem::path& folder, const StoredPack& stored);

}  // namespace fb
