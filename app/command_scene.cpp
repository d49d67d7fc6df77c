// `frontbench info` and `frontbench check`.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/guarded_child.h"
#include "app/progress_display.h"
#include "base/hash.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

struct LevelRow {
    std::uint64_t nodes = 0, leaves = 0, textured = 0, untextured = 0, texels = 0, diskBytes = 0, residentBytes = 0;
    double errorMax = 0.0, errorSum = 0.0;
    std::uint64_t triangles() const { return textured + untextured; }
};

// Of the blocks of one kind; empty when there are none.
std::vector<LevelRow> gatherLevels(const Hierarchy& h, BlockKind kind) {
    std::vector<LevelRow> rows;
    for (NodeId n = 0; n < h.size(); ++n) {
        if (h.kinds[h.block[n]] != kind) continue;
        if (h.level[n] >= rows.size()) rows.resize(h.level[n] + 1u);
        LevelRow& row = rows[h.level[n]];
        ++row.nodes;
        row.leaves += h.isLeaf(n) ? 1 : 0;
        row.textured += h.texturedTriangles[n];
        row.untextured += h.untexturedTriangles[n];
        row.texels += std::uint64_t{h.textureWidth[n]} * h.textureHeight[n];
        row.diskBytes += h.payload[n].sizeBytes;
        row.residentBytes += h.residentBytes[n];
        row.errorMax = std::max<double>(row.errorMax, h.geometricErrorMetres[n]);
        row.errorSum += h.geometricErrorMetres[n];
    }
    return rows;
}

nlohmann::ordered_json levelJson(std::size_t level, const LevelRow& row) {
    return {{"level", level},
            {"nodes", row.nodes},
            {"leaves", row.leaves},
            {"textured_triangles", row.textured},
            {"untextured_triangles", row.untextured},
            {"texels", row.texels},
            {"disk_bytes", row.diskBytes},
            {"resident_bytes", row.residentBytes},
            {"error_m", {{"mean", row.errorSum / static_cast<double>(row.nodes)}, {"max", row.errorMax}}}};
}

struct SceneLevels {
    std::vector<LevelRow> objects, terrain;
};

nlohmann::ordered_json levelsJson(const std::vector<LevelRow>& levels) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < levels.size(); ++i) json.push_back(levelJson(i, levels[i]));
    return json;
}

void printJson(const Scene& scene, const SceneLevels& levels) {
    const SceneInfo& info = scene.info;
    nlohmann::ordered_json json = {{"name", info.name},
                                   {"program", info.program},
                                   {"scene_hash", hashText(scene.sceneHash)},
                                   {"up", info.up == UpAxis::y ? "y" : "z"},
                                   {"origin", {info.origin.x, info.origin.y, info.origin.z}},
                                   {"bounds",
                                    {{"min", {info.bounds.min.x, info.bounds.min.y, info.bounds.min.z}},
                                     {"max", {info.bounds.max.x, info.bounds.max.y, info.bounds.max.z}}}},
                                   {"blocks", scene.hierarchy.rootCount},
                                   {"nodes", scene.hierarchy.size()},
                                   {"source_triangles", info.sourceTriangles},
                                   {"source_area_m2", info.sourceAreaSquareMetres},
                                   {"source_files", info.sourceFiles},
                                   {"report", info.reportLines}};
    json["levels"] = levelsJson(levels.objects);
    if (!levels.terrain.empty()) json["terrain_levels"] = levelsJson(levels.terrain);
    std::printf("%s\n", json.dump(2).c_str());
}

void printLevels(const std::vector<LevelRow>& levels) {
    std::printf("%5s %7s %7s %10s %10s %12s %10s %10s %12s %12s\n", "level", "nodes", "leaves", "textured", "untextured",
                "texels", "disk MB", "memory MB", "mean error m", "max error m");
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const LevelRow& row = levels[i];
        std::printf("%5zu %7llu %7llu %10llu %10llu %12llu %10.2f %10.2f %12.4g %12.4g\n", i,
                    static_cast<unsigned long long>(row.nodes), static_cast<unsigned long long>(row.leaves),
                    static_cast<unsigned long long>(row.textured), static_cast<unsigned long long>(row.untextured),
                    static_cast<unsigned long long>(row.texels), static_cast<double>(row.diskBytes) / 1e6,
                    static_cast<double>(row.residentBytes) / 1e6, row.errorSum / static_cast<double>(row.nodes),
                    row.errorMax);
    }
}

void printTable(const Scene& scene, const SceneLevels& levels) {
    const SceneInfo& info = scene.info;
    const glm::dvec3 size = info.bounds.size();
    std::printf("%s  (%s, scene %s)\n", info.name.c_str(), info.program.c_str(), hashText(scene.sceneHash).c_str());
    std::printf("%.6g x %.6g x %.6g m, %s up, origin %.17g %.17g %.17g\n", size.x, size.y, size.z,
                info.up == UpAxis::y ? "y" : "z", info.origin.x, info.origin.y, info.origin.z);
    std::printf("%u blocks, %u nodes, %llu source triangles, %.6g m2\n\n", scene.hierarchy.rootCount,
                scene.hierarchy.size(), static_cast<unsigned long long>(info.sourceTriangles),
                info.sourceAreaSquareMetres);
    if (!levels.objects.empty()) printLevels(levels.objects);
    if (!levels.terrain.empty()) {
        std::printf("%sterrain\n", levels.objects.empty() ? "" : "\n");
        printLevels(levels.terrain);
    }
    for (const std::string& line : info.reportLines) std::printf("note: %s\n", line.c_str());
}

}  // namespace

Result<void> runInfo(const std::filesystem::path& folder, bool json) {
    Result<Scene> scene = openScene(folder);
    if (!scene) return passOn(scene);
    const SceneLevels levels{gatherLevels(scene->hierarchy, BlockKind::objects),
                             gatherLevels(scene->hierarchy, BlockKind::terrain)};
    if (json) {
        printJson(*scene, levels);
    } else {
        printTable(*scene, levels);
    }
    return {};
}

Result<void> runCheck(const std::filesystem::path& folder, ProgressStyle style) {
    watchForStop();
    Result<SceneCheck> check = checkScene(folder, showProgress(style));
    endProgress(style);
    if (!check) return passOn(check);
    for (const std::string& fault : check->faults) std::printf("%s\n", fault.c_str());
    if (!check->faults.empty()) {
        return failure(folder.string(), {}, std::to_string(check->faults.size()) + (check->faults.size() == 1 ? " fault" : " faults"),
                       "build the scene again: intact blocks are kept");
    }
    std::printf("%s: %llu payloads of %.1f MB are sound\n", folder.string().c_str(),
                static_cast<unsigned long long>(check->payloads), static_cast<double>(check->bytes) / 1e6);
    return {};
}

}  // namespace fb
