// Camera paths: built-in ones made from a scene's bounds and walk hints, and recorded ones in TOML files.
// A path is a camera as a function of time, the same at any frame rate.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera.h"
#include "base/result.h"
#include "scenefile/scene.h"

namespace fb {

struct PathKey {
    double timeSeconds = 0.0;
    Camera camera;
    bool cut = false;  // the camera jumps here: no motion from the key before
};

// Keys by rising time. Between keys the eye moves on a centripetal Catmull-Rom spline and the orientation turns on the
// shortest arc; before the first and after the last key the camera rests.
struct CameraPath {
    std::string name;
    std::vector<PathKey> keys;

    [[nodiscard]] double durationSeconds() const { return keys.empty() ? 0.0 : keys.back().timeSeconds; }
    [[nodiscard]] Camera at(double timeSeconds) const;
    // m/s by the slope of the spline; 0 at a cut and outside the path.
    [[nodiscard]] glm::dvec3 velocityAt(double timeSeconds) const;
};

[[nodiscard]] std::vector<std::string_view> builtInPathNames();  // still walk drive fly walk-to-fly shake jump

// `nameOrFile`: a built-in name, or a .toml file (resources/paths/ is searched too). drive is the walk at ten times the
// speed; shake moves back and forth by small amounts; jump cuts between distant views.
[[nodiscard]] Result<CameraPath> loadPath(std::string_view nameOrFile, const SceneInfo& scene);

[[nodiscard]] Result<CameraPath> parsePath(std::string_view toml, std::string_view name);
[[nodiscard]] std::string pathToml(const CameraPath& path);

}  // namespace fb
