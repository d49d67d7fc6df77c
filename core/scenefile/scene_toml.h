// scene.toml: what people want to know of a scene, and what the program needs beside the hierarchy (origin,
// up axis, walk hints). Written once by writeScene(); people may edit names and walk hints.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "scenefile/hierarchy.h"
#include "scenefile/scene.h"

namespace fb {

struct SceneToml {
    SceneInfo info;
    std::uint64_t hierarchyHash = 0;  // of the hierarchy.bin that was written with it
};

// An error when a number of `info` is not finite or out of range.
[[nodiscard]] Result<std::string> sceneTomlText(const SceneToml& scene, const Hierarchy& hierarchy);
[[nodiscard]] Result<SceneToml> parseSceneToml(std::string_view text, const std::string& what);

}  // namespace fb
