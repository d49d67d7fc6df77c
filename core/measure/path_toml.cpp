// Camera paths as TOML text, in and out.
#include <toml++/toml.h>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "base/file_io.h"
#include "measure/camera_path.h"
#include "measure/number_text.h"
#include "measure/slerp_by_halving.h"

namespace fb {
namespace {

constexpr std::size_t kTextCapBytes = 64u << 20;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kFovyLowDegrees = 1.0, kFovyHighDegrees = 170.0;
constexpr double kNearLowMetres = 1e-12, kNearHighMetres = 1e6;

std::string lineOf(const toml::node& node) {
    return "line " + std::to_string(node.source().begin.line);
}

// One table of the file being read, with the file's name for errors.
struct Place {
    std::string_view file;
    const toml::table& table;

    [[nodiscard]] tl::unexpected<Error> refuse(const toml::node& node, std::string reason,
                                               std::string hint = {}) const {
        return failure(std::string(file), lineOf(node), std::move(reason), std::move(hint));
    }

    // Of a whole number or a float, which is finite and within the range.
    [[nodiscard]] Result<double> number(const toml::node& node, std::string_view key, double low,
                                        double high) const {
        double value = 0.0;
        if (const auto* whole = node.as_integer()) {
            value = static_cast<double>(whole->get());
        } else if (const auto* real = node.as_floating_point()) {
            value = real->get();
        } else {
            return refuse(node, std::string(key) + " is not a number");
        }
        if (!std::isfinite(value)) return refuse(node, std::string(key) + " is not finite");
        if (value < low || value > high) {
            std::string range;
            appendNumber(range, low);
            range += " to ";
            appendNumber(range, high);
            return refuse(node, std::string(key) + " is out of range", "it should be in " + range);
        }
        return value;
    }

    [[nodiscard]] Result<double> numberOr(std::string_view key, double initial, double low,
                                          double high) const {
        const toml::node* node = table.get(key);
        return node ? number(*node, key, low, high) : Result<double>(initial);
    }

    // Null where the key is absent.
    template <std::size_t kCount>
    [[nodiscard]] Result<std::optional<std::array<double, kCount>>> numbers(std::string_view key,
                                                                            double cap) const {
        const toml::node* node = table.get(key);
        if (!node) return std::nullopt;
        const toml::array* list = node->as_array();
        if (!list || list->size() != kCount) {
            return refuse(*node,
                          std::string(key) + " is not a list of " + std::to_string(kCount) + " numbers");
        }
        std::array<double, kCount> values{};
        for (std::size_t i = 0; i < kCount; ++i) {
            Result<double> value = number((*list)[i], key, -cap, cap);
            if (!value) return passOn(value);
            values[i] = *value;
        }
        return values;
    }

    [[nodiscard]] Result<std::optional<glm::dvec3>> vector(std::string_view key, double cap) const {
        Result<std::optional<std::array<double, 3>>> values = numbers<3>(key, cap);
        if (!values) return passOn(values);
        if (!*values) return std::nullopt;
        return glm::dvec3((**values)[0], (**values)[1], (**values)[2]);
    }

    // An error where the table has another key than these.
    [[nodiscard]] Result<void> onlyHas(std::initializer_list<std::string_view> known,
                                       std::string_view where) const {
        for (const auto& [key, node] : table) {
            if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
            std::string hint = "there are:";
            for (std::string_view name : known) hint += " " + std::string(name);
            return refuse(node, "\"" + std::string(key.str()) + "\" is not part of " + std::string(where),
                          hint);
        }
        return {};
    }
};

Result<glm::dquat> orientationByTarget(const Place& place, const glm::dvec3& eye,
                                       const glm::dvec3& defaultUp) {
    Result<std::optional<glm::dvec3>> target = place.vector("look_at", kPathCoordinateCap);
    if (!target) return passOn(target);
    if (!*target) return place.refuse(place.table, "a key needs orientation or look_at");
    Result<std::optional<glm::dvec3>> up = place.vector("up", kPathCoordinateCap);
    if (!up) return passOn(up);
    const glm::dvec3 way = **target - eye, upward = up->value_or(defaultUp);
    const double size = glm::length(way), upSize = glm::length(upward);
    if (size < 1e-9) return place.refuse(*place.table.get("look_at"), "look_at is the eye's own place");
    if (upSize < 1e-9) return place.refuse(place.table, "up has no length");
    if (glm::length(glm::cross(way / size, upward / upSize)) < 1e-6) {
        return place.refuse(place.table, "the camera looks along up", "give up another direction");
    }
    return lookAt(glm::dvec3(0.0), way / size, upward / upSize).orientation;
}

Result<glm::dquat> readOrientation(const Place& place, const glm::dvec3& eye, const glm::dvec3& defaultUp) {
    Result<std::optional<std::array<double, 4>>> given = place.numbers<4>("orientation", 2.0);
    if (!given) return passOn(given);
    if (!*given) return orientationByTarget(place, eye, defaultUp);
    for (const char* other : {"look_at", "up"}) {
        if (const toml::node* node = place.table.get(other)) {
            return place.refuse(*node, std::string(other) + " beside orientation", "one of them is enough");
        }
    }
    const auto& [x, y, z, w] = **given;
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    if (std::abs(norm - 1.0) > 1e-3) {
        return place.refuse(*place.table.get("orientation"), "orientation is not a unit quaternion",
                            "its length is " + fixedText(norm, 6));
    }
    const glm::dquat q(w, x, y, z);
    // What is normalised already stays bit by bit what it is.
    return std::abs(norm - 1.0) < 1e-14 ? q : normalisedQuat(q);
}

Result<double> readFovyRadians(const Place& place) {
    if (const toml::node* node = place.table.get("fovy_radians")) {
        if (place.table.get("fovy"))
            return place.refuse(*node, "fovy_radians beside fovy", "one of them is enough");
        return place.number(*node, "fovy_radians", kFovyLowDegrees * kDegree, kFovyHighDegrees * kDegree);
    }
    Result<double> degrees = place.numberOr("fovy", 60.0, kFovyLowDegrees, kFovyHighDegrees);
    if (!degrees) return degrees;
    return *degrees * kDegree;
}

Result<PathKey> readKey(const Place& place, const glm::dvec3& defaultUp) {
    Result<void> known = place.onlyHas(
        {"time", "eye", "orientation", "look_at", "up", "fovy", "fovy_radians", "near", "cut"}, "a key");
    if (!known) return passOn(known);

    PathKey key;
    const toml::node* time = place.table.get("time");
    if (!time) return place.refuse(place.table, "a key needs time");
    Result<double> seconds = place.number(*time, "time", 0.0, kPathTimeCap);
    if (!seconds) return passOn(seconds);
    key.timeSeconds = *seconds;

    Result<std::optional<glm::dvec3>> eye = place.vector("eye", kPathCoordinateCap);
    if (!eye) return passOn(eye);
    if (!*eye) return place.refuse(place.table, "a key needs eye");
    key.camera.eye = **eye;

    Result<glm::dquat> orientation = readOrientation(place, key.camera.eye, defaultUp);
    if (!orientation) return passOn(orientation);
    key.camera.orientation = *orientation;
    Result<double> fovy = readFovyRadians(place);
    if (!fovy) return passOn(fovy);
    key.camera.fovyRadians = *fovy;
    Result<double> near = place.numberOr("near", key.camera.nearMetres, kNearLowMetres, kNearHighMetres);
    if (!near) return passOn(near);
    key.camera.nearMetres = *near;

    if (const toml::node* cut = place.table.get("cut")) {
        if (!cut->is_boolean()) return place.refuse(*cut, "cut is neither true nor false");
        key.cut = cut->as_boolean()->get();
    }
    return key;
}

Result<CameraPath> readKeys(const Place& top) {
    Result<std::optional<glm::dvec3>> up = top.vector("up", kPathCoordinateCap);
    if (!up) return passOn(up);
    const glm::dvec3 defaultUp = up->value_or(glm::dvec3(0, 1, 0));

    CameraPath path;
    path.name = std::filesystem::path(std::string(top.file)).stem().string();
    const toml::node* node = top.table.get("key");
    const toml::array* keys = node ? node->as_array() : nullptr;
    if (!keys || keys->empty())
        return failure(std::string(top.file), {}, "the path has no keys", "each is a [[key]]");
    if (keys->size() > kPathKeyCap) {
        return top.refuse((*keys)[kPathKeyCap], "more than " + std::to_string(kPathKeyCap) + " keys");
    }
    for (const toml::node& entry : *keys) {
        if (!entry.is_table()) return top.refuse(entry, "a key is not a table");
        const Place place{top.file, *entry.as_table()};
        Result<PathKey> key = readKey(place, defaultUp);
        if (!key) return passOn(key);
        if (!path.keys.empty() && key->timeSeconds <= path.keys.back().timeSeconds) {
            return place.refuse(*place.table.get("time"), "time is not later than the key's before");
        }
        path.keys.push_back(*key);
    }
    return path;
}

// TOML tells -0.0 and whole floats from integers by their point.
void appendReal(std::string& text, double value) {
    const std::size_t start = text.size();
    appendNumber(text, value);
    if (text.find_first_of(".e", start) == std::string::npos) text += ".0";
}

void appendList(std::string& text, std::string_view key, std::initializer_list<double> values) {
    text += std::string(key) + " = [";
    bool first = true;
    for (double value : values) {
        if (!first) text += ", ";
        first = false;
        appendReal(text, value);
    }
    text += "]\n";
}

}  // namespace

Result<CameraPath> parsePath(std::string_view text, std::string_view name) {
    if (text.size() > kTextCapBytes) {
        return failure(std::string(name), {},
                       "the text is longer than " + std::to_string(kTextCapBytes) + " bytes");
    }
    toml::table root;
    try {
        root = toml::parse(text, name);
    } catch (const toml::parse_error& problem) {
        return failure(std::string(name), "line " + std::to_string(problem.source().begin.line),
                       std::string(problem.description()), "a path is a TOML file");
    }
    const Place top{name, root};
    if (Result<void> known = top.onlyHas({"about", "up", "key"}, "a path"); !known) return passOn(known);
    return readKeys(top);
}

std::string pathToml(const CameraPath& path) {
    std::string text =
        "# Camera path. time in s; eye in m relative to the scene's origin; orientation x, y, z, w;\n"
        "# fovy in degrees (60 where absent); near in m (0.05 where absent).\n";
    const Camera defaults;
    for (const PathKey& key : path.keys) {
        const Camera& camera = key.camera;
        const glm::dquat& q = camera.orientation;
        text += "\n[[key]]\ntime = ";
        appendReal(text, key.timeSeconds);
        text += "\n";
        appendList(text, "eye", {camera.eye.x, camera.eye.y, camera.eye.z});
        appendList(text, "orientation", {q.x, q.y, q.z, q.w});
        if (camera.fovyRadians != 60.0 * kDegree) {
            // Degrees for people where they say it exactly.
            const double degrees = camera.fovyRadians / kDegree;
            const bool exact = degrees * kDegree == camera.fovyRadians;
            text += exact ? "fovy = " : "fovy_radians = ";
            appendReal(text, exact ? degrees : camera.fovyRadians);
            text += "\n";
        }
        if (camera.nearMetres != defaults.nearMetres) {
            text += "near = ";
            appendReal(text, camera.nearMetres);
            text += "\n";
        }
        if (key.cut) text += "cut = true\n";
    }
    return text;
}

Result<void> savePath(const CameraPath& path, const std::filesystem::path& file) {
    if (path.keys.size() > kPathKeyCap) {
        return failure(file.string(), {}, "the path has more than " + std::to_string(kPathKeyCap) + " keys");
    }
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
        const bool rising = i == 0 || path.keys[i].timeSeconds > path.keys[i - 1].timeSeconds;
        if (isUsable(path.keys[i].camera) && rising) continue;
        return failure(file.string(), "key " + std::to_string(i),
                       "the path's key has no usable time or camera");
    }
    if (file.has_parent_path()) {
        if (Result<void> made = makeFolder(file.parent_path()); !made) return made;
    }
    return writeFileAtomically(file, pathToml(path));
}

}  // namespace fb
