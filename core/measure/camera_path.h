// Camera paths: built-in ones made from a scene's bounds and walk hints, and recorded ones in TOML files.
// A path is a camera as a function of time, the same at any frame rate.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera.h"
#include "base/result.h"
#include "scenefile/scene.h"

namespace fb {

// What a path file may hold; more is refused.
inline constexpr std::size_t kPathKeyCap = 100000;
inline constexpr double kPathCoordinateCap = 1e12;  // metres from the origin
inline constexpr double kPathTimeCap = 1e7;         // seconds

struct PathKey {
    double timeSeconds = 0.0;
    Camera camera;
    bool cut = false;  // the camera jumps here: no motion from the key before
};

// Keys by rising time. Between keys the eye moves on a centripetal Catmull-Rom spline and the orientation
// turns on the shortest arc; before the first and after the last key the camera rests, and so it does from
// the key before a cut until the cut. The same numbers on every machine.
struct CameraPath {
    std::string name;
    std::vector<PathKey> keys;

    [[nodiscard]] double durationSeconds() const { return keys.empty() ? 0.0 : keys.back().timeSeconds; }
    [[nodiscard]] Camera at(double timeSeconds) const;
    // m/s by the slope of the spline; 0 where the camera rests before a cut, at the cut itself, and outside the path.
    [[nodiscard]] glm::dvec3 velocityAt(double timeSeconds) const;
};

// still walk drive fly walk-to-fly shake jump
[[nodiscard]] std::vector<std::string_view> builtInPathNames();

// `nameOrFile`: a built-in name, or a .toml file (resources/paths/ is searched too, with or without ".toml").
// Built-in paths last 30 s. drive is the walk at ten times the speed: where the way is shorter than the ten
// walks it covers, the way is walked round and round, or back and forth. shake moves back and forth by small
// amounts; jump cuts between distant views every 2 s.
[[nodiscard]] Result<CameraPath> loadPath(std::string_view nameOrFile, const SceneInfo& scene);

// TOML: a [[key]] table each with time (s), eye (m), orientation = [x, y, z, w] or look_at and up, and, where
// they differ from the defaults, fovy (degrees; or fovy_radians), near (m), cut. A top-level `up` is for all
// keys without their own. Everything is checked; an error names file and line. `name` is the file's name.
[[nodiscard]] Result<CameraPath> parsePath(std::string_view toml, std::string_view name);
// Reading it back gives the same path, bit by bit, but for its name.
[[nodiscard]] std::string pathToml(const CameraPath& path);
[[nodiscard]] Result<void> savePath(const CameraPath& path, const std::filesystem::path& file);

}  // namespace fb
