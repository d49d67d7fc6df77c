#include <toml++/toml.h>
#include <charconv>
#include <cmath>

#include "scenefile/limits.h"
#include "scenefile/scene_toml.h"

namespace fb {
namespace {

std::string lineOf(const toml::node& node) {
    return "line " + std::to_string(node.source().begin.line);
}

// Takes values out of one table; the first that is missing, of the wrong type or out of range becomes the
// error.
class TableReader {
  public:
    TableReader(const toml::table& table, const std::string& what) : table_(table), what_(what) {}

    void text(const char* key, std::string& into) {
        if (const toml::node* node = find(key)) {
            if (node->is_string())
                into = node->as_string()->get();
            else
                refuse(*node, key, "a text in quotes");
        }
    }
    void texts(const char* key, std::vector<std::string>& into) {
        const toml::node* node = find(key);
        if (!node) return;
        if (!node->is_array()) return refuse(*node, key, "a list of texts");
        for (const toml::node& element : *node->as_array()) {
            if (!element.is_string()) return refuse(element, key, "a list of texts");
            into.push_back(element.as_string()->get());
        }
    }
    void count(const char* key, std::uint64_t& into) {
        if (const toml::node* node = find(key)) {
            if (node->is_integer() && node->as_integer()->get() >= 0) {
                into = static_cast<std::uint64_t>(node->as_integer()->get());
            } else {
                refuse(*node, key, "a whole number, not negative");
            }
        }
    }
    void real(const char* key, double low, double high, double& into) {
        if (const toml::node* node = find(key); node && !number(*node, low, high, into)) {
            refuse(*node, key, "a finite number in range");
        }
    }
    void point(const char* key, glm::dvec3& into) {
        if (const toml::node* node = find(key); node && !coordinates(*node, into)) {
            refuse(*node, key, "three finite numbers in range");
        }
    }
    void hash(const char* key, std::uint64_t& into) {
        const toml::node* node = find(key);
        if (!node) return;
        const std::string digits = node->is_string() ? node->as_string()->get() : std::string();
        const char* end = digits.data() + digits.size();
        const auto parsed = std::from_chars(digits.data(), end, into, 16);
        if (digits.size() != 16 || parsed.ptr != end || parsed.ec != std::errc()) {
            refuse(*node, key, "16 hexadecimal digits in quotes");
        }
    }
    void up(const char* key, UpAxis& into) {
        const toml::node* node = find(key);
        if (!node) return;
        const std::string axis = node->is_string() ? node->as_string()->get() : std::string();
        if (axis != "y" && axis != "z") return refuse(*node, key, "\"y\" or \"z\"");
        into = axis == "y" ? UpAxis::y : UpAxis::z;
    }
    void walks(const char* key, std::vector<WalkHint>& into) {
        const toml::node* node = table_.get(key);
        if (!node || failed()) return;  // a scene need not have one
        if (!node->is_array()) return refuse(*node, key, "a list of tables");
        for (const toml::node& element : *node->as_array()) {
            const toml::table* walk = element.as_table();
            const toml::array* points = walk ? (*walk)["points"].as_array() : nullptr;
            if (!points) return refuse(element, key, "a table with points");
            WalkHint& hint = into.emplace_back();
            for (const toml::node& each : *points) {
                if (!coordinates(each, hint.points.emplace_back()))
                    return refuse(each, key, "three finite numbers in range");
            }
        }
    }

    [[nodiscard]] bool failed() const { return !fault_.reason.empty(); }
    [[nodiscard]] const Error& fault() const { return fault_; }

  private:
    const toml::node* find(const char* key) {
        if (failed()) return nullptr;
        const toml::node* node = table_.get(key);
        if (!node)
            fault_ = {
                Error::Kind::failed, what_, {}, std::string("\"") + key + "\" is missing", "build it again"};
        return node;
    }
    void refuse(const toml::node& node, const char* key, const char* expected) {
        fault_ = {
            Error::Kind::failed, what_, lineOf(node), std::string("\"") + key + "\" must be " + expected, {}};
    }
    static bool number(const toml::node& node, double low, double high, double& into) {
        if (!node.is_number()) return false;
        into = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                 : node.as_floating_point()->get();
        return into >= low && into <= high;  // false for NaN
    }
    static bool coordinates(const toml::node& node, glm::dvec3& into) {
        const toml::array* array = node.as_array();
        if (!array || array->size() != 3) return false;
        for (int axis = 0; axis < 3; ++axis) {
            const toml::node& element = (*array)[static_cast<std::size_t>(axis)];
            if (!number(element, -kMaxCoordinateMetres, kMaxCoordinateMetres, into[axis])) return false;
        }
        return true;
    }

    const toml::table& table_;
    const std::string& what_;
    Error fault_;
};

Result<void> checkVersion(const toml::table& root, const std::string& what) {
    const toml::node* node = root.get("format");
    if (!node || !node->is_integer()) {
        return failure(what, node ? lineOf(*node) : "", "\"format\" must be a whole number",
                       "is it a scene?");
    }
    const std::int64_t version = node->as_integer()->get();
    if (version == kSceneFormatVersion) return {};
    return failure(what, lineOf(*node),
                   "made by version " + std::to_string(version) + "; this program reads " +
                       std::to_string(kSceneFormatVersion),
                   "build it again");
}

}  // namespace

Result<SceneToml> parseSceneToml(std::string_view text, const std::string& what) {
    toml::table root;
    try {
        root = toml::parse(text, what);
    } catch (const toml::parse_error& problem) {
        return failure(what, "line " + std::to_string(problem.source().begin.line),
                       std::string(problem.description()));
    }
    if (Result<void> version = checkVersion(root, what); !version) return passOn(version);
    SceneToml scene;
    SceneInfo& info = scene.info;
    TableReader in(root, what);
    in.text("program", info.program);
    in.text("name", info.name);
    in.up("up", info.up);
    in.point("origin", info.origin);
    in.point("bounds_min", info.bounds.min);
    in.point("bounds_max", info.bounds.max);
    in.count("source_triangles", info.sourceTriangles);
    in.real("source_area_m2", 0.0, std::numeric_limits<double>::max(), info.sourceAreaSquareMetres);
    in.hash("source_hash", info.sourceHash);
    in.hash("build_settings_hash", info.buildSettingsHash);
    in.count("desired_triangles", info.desiredTriangles);
    in.count("level_factor", info.levelFactor);
    in.hash("hierarchy_hash", scene.hierarchyHash);
    in.texts("source_files", info.sourceFiles);
    in.texts("report", info.reportLines);
    in.walks("walk", info.walks);
    if (in.failed()) return tl::make_unexpected(in.fault());
    if (info.bounds.empty()) return failure(what, {}, "\"bounds_min\" must not exceed \"bounds_max\"");
    return scene;
}

}  // namespace fb
