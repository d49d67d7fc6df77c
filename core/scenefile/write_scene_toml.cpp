#include <cmath>
#include <limits>

#include "base/hash.h"
#include "scenefile/limits.h"
#include "scenefile/scene_toml.h"
#include "scenefile/toml_text.h"

namespace fb {
namespace {

bool inRange(const glm::dvec3& v) {
    const auto fits = [](double x) { return std::abs(x) <= kMaxCoordinateMetres; };  // false for NaN
    return fits(v.x) && fits(v.y) && fits(v.z);
}

Result<void> checkInfo(const SceneInfo& info) {
    const auto fault = [](const char* reason) { return failure("scene.toml", {}, reason); };
    if (!inRange(info.origin)) return fault("the origin is not finite or out of range");
    if (info.bounds.empty() || !inRange(info.bounds.min) || !inRange(info.bounds.max)) {
        return fault("the bounds are empty, not finite or out of range");
    }
    if (!(info.sourceAreaSquareMetres >= 0.0) || !std::isfinite(info.sourceAreaSquareMetres)) {
        return fault("the source area is negative or not finite");
    }
    if (info.sourceTriangles > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
        return fault("the number of source triangles is out of range");
    }
    for (const WalkHint& walk : info.walks) {
        for (const glm::dvec3& point : walk.points) {
            if (!inRange(point)) return fault("a walk hint is not finite or out of range");
        }
    }
    return {};
}

std::string tomlPoint(const glm::dvec3& v) {
    return "[" + tomlReal(v.x) + ", " + tomlReal(v.y) + ", " + tomlReal(v.z) + "]";
}

std::string tomlList(const std::vector<std::string>& texts) {
    std::string out = "[";
    for (const std::string& text : texts) out += "\n  " + tomlString(text) + ",";
    return out + (texts.empty() ? "]" : "\n]");
}

std::string counts(const Hierarchy& h) {
    std::uint64_t all = 0;
    std::uint64_t leaves = 0;
    for (NodeId n = 0; n < h.size(); ++n) {
        all += h.triangles(n);
        if (h.isLeaf(n)) leaves += h.triangles(n);
    }
    std::string out = "\n[counts]\n";
    out += "blocks = " + std::to_string(h.rootCount) + "\n";
    out += "nodes = " + std::to_string(h.size()) + "\n";
    out += "levels = " + std::to_string(h.maxLevel() + 1) + "\n";
    out += "triangles = " + std::to_string(all) + "  # of all nodes\n";
    out += "leaf_triangles = " + std::to_string(leaves) + "\n";
    return out;
}

Box3d boundsOf(const Hierarchy& h) {
    Box3d box;
    for (NodeId root = 0; root < h.rootCount; ++root) {
        box.grow(glm::dvec3(h.bounds[root].min));
        box.grow(glm::dvec3(h.bounds[root].max));
    }
    return box;
}

}  // namespace

Result<std::string> sceneTomlText(const SceneToml& scene, const Hierarchy& hierarchy) {
    SceneInfo info = scene.info;
    if (info.bounds.empty()) info.bounds = boundsOf(hierarchy);
    if (info.program.empty()) info.program = "frontbench " FB_VERSION;
    if (Result<void> sound = checkInfo(info); !sound) return passOn(sound);

    std::string out = "# A Frontbench scene. Lengths are metres, hashes are XXH3.\n";
    out += "format = " + std::to_string(kSceneFormatVersion) + "\n";
    out += "program = " + tomlString(info.program) + "\n";
    out += "name = " + tomlString(info.name) + "\n";
    out += std::string("up = ") + (info.up == UpAxis::y ? "\"y\"" : "\"z\"") + "\n";
    out +=
        "origin = " + tomlPoint(info.origin) + "  # added to a position of this scene gives the source's\n";
    out += "bounds_min = " + tomlPoint(info.bounds.min) + "  # relative to the origin\n";
    out += "bounds_max = " + tomlPoint(info.bounds.max) + "\n";
    out += "source_triangles = " + std::to_string(info.sourceTriangles) + "\n";
    out += "source_area_m2 = " + tomlReal(info.sourceAreaSquareMetres) + "\n";
    out += "source_hash = \"" + hashText(info.sourceHash) + "\"\n";
    out += "build_settings_hash = \"" + hashText(info.buildSettingsHash) + "\"\n";
    out += "desired_triangles = " + std::to_string(info.desiredTriangles) + "\n";
    out += "level_factor = " + std::to_string(info.levelFactor) + "\n";
    out += "hierarchy_hash = \"" + hashText(scene.hierarchyHash) + "\"  # of hierarchy.bin\n";
    out += "source_files = " + tomlList(info.sourceFiles) + "\n";
    out += "report = " + tomlList(info.reportLines) + "  # what the import dropped or repaired\n";
    out += counts(hierarchy);
    for (const WalkHint& walk : info.walks) {
        out += "\n[[walk]]\npoints = [";
        for (const glm::dvec3& point : walk.points) out += "\n  " + tomlPoint(point) + ",";
        out += walk.points.empty() ? "]\n" : "\n]\n";
    }
    return out;
}

}  // namespace fb
