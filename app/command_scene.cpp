// `frontbench info` and `frontbench check`.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/guarded_child.h"
#include "app/progress_display.h"
#include "base/hash.h"
#include "measure/scene_health.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

nlohmann::ordered_json levelJson(std::size_t level, const LevelFacts& row, std::uint64_t desiredTriangles) {
    return {{"level", level},
            {"nodes", row.nodes},
            {"leaves", row.leaves},
            {"textured_triangles", row.texturedTriangles},
            {"untextured_triangles", row.untexturedTriangles},
            {"skirt_triangles", row.skirtTriangles},
            {"texels", row.texels},
            {"disk_bytes", row.diskBytes},
            {"resident_bytes", row.residentBytes},
            {"error_m", {{"mean", row.meanError()}, {"max", row.errorMaxMetres}}},
            {"gap_without_skirts_m", row.gapMaxMetres},
            {"fill", {{"mean", row.fill(desiredTriangles)}, {"p5", row.fillLow}, {"p95", row.fillHigh}}},
            {"stuck_nodes", row.stuckNodes},
            {"untextured_nodes", row.untexturedNodes}};
}

nlohmann::ordered_json levelsJson(const std::vector<LevelFacts>& levels, std::uint64_t desiredTriangles) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < levels.size(); ++i) json.push_back(levelJson(i, levels[i], desiredTriangles));
    return json;
}

void printJson(const Scene& scene, const SceneHealth& health) {
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
    json["desired_triangles"] = info.desiredTriangles;
    json["levels"] = levelsJson(health.objects, info.desiredTriangles);
    if (!health.terrain.empty()) json["terrain_levels"] = levelsJson(health.terrain, info.desiredTriangles);
    json["health"] = {{"depth", health.depth},
                      {"empty_pieces", health.emptyPieces},
                      {"root_resident_bytes", health.rootBytes},
                      {"untextured_share", health.untexturedShare},
                      {"error_monotone", health.errorIsMonotone},
                      {"warnings", health.warnings}};
    std::printf("%s\n", json.dump(2).c_str());
}

unsigned long long number(std::uint64_t value) { return value; }

void printLevels(const std::vector<LevelFacts>& levels, std::uint64_t desiredTriangles) {
    std::printf("%5s %7s %7s %10s %10s %9s %12s %9s %9s %11s %11s %9s  %s\n", "level", "nodes", "leaves", "textured",
                "untextured", "skirts", "texels", "disk MB", "memory MB", "mean err m", "max err m", "stuck",
                "fill (5..95 %)");
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const LevelFacts& row = levels[i];
        std::printf("%5zu %7llu %7llu %10llu %10llu %9llu %12llu %9.2f %9.2f %11.4g %11.4g %9llu  %.2f (%.2f..%.2f)\n", i,
                    number(row.nodes), number(row.leaves), number(row.texturedTriangles), number(row.untexturedTriangles),
                    number(row.skirtTriangles), number(row.texels), static_cast<double>(row.diskBytes) / 1e6,
                    static_cast<double>(row.residentBytes) / 1e6, row.meanError(), row.errorMaxMetres,
                    number(row.stuckNodes), row.fill(desiredTriangles), row.fillLow, row.fillHigh);
    }
}

double widestGap(const SceneHealth& health) {
    double widest = 0.0;
    for (const std::vector<LevelFacts>* levels : {&health.objects, &health.terrain}) {
        for (const LevelFacts& level : *levels) widest = std::max(widest, level.gapMaxMetres);
    }
    return widest;
}

void printHealth(const SceneHealth& health) {
    std::printf("\ndepth %llu, error %s, %llu empty pieces left out, %.3g %% of leaf triangles untextured\n",
                number(health.depth), health.errorIsMonotone ? "monotone" : "NOT monotone", number(health.emptyPieces),
                100.0 * health.untexturedShare);
    std::printf("roots take %.1f MB of memory; skirts close gaps of up to %.4g m between levels\n",
                static_cast<double>(health.rootBytes) / 1e6, widestGap(health));
    for (const std::string& line : health.warnings) std::printf("warning: %s\n", line.c_str());
}

void printTable(const Scene& scene, const SceneHealth& health) {
    const SceneInfo& info = scene.info;
    const glm::dvec3 size = info.bounds.size();
    std::printf("%s  (%s, scene %s)\n", info.name.c_str(), info.program.c_str(), hashText(scene.sceneHash).c_str());
    std::printf("%.6g x %.6g x %.6g m, %s up, origin %.17g %.17g %.17g\n", size.x, size.y, size.z,
                info.up == UpAxis::y ? "y" : "z", info.origin.x, info.origin.y, info.origin.z);
    std::printf("%u blocks, %u nodes, %llu source triangles, %.6g m2\n\n", scene.hierarchy.rootCount,
                scene.hierarchy.size(), number(info.sourceTriangles), info.sourceAreaSquareMetres);
    if (!health.objects.empty()) printLevels(health.objects, info.desiredTriangles);
    if (!health.terrain.empty()) {
        std::printf("%sterrain\n", health.objects.empty() ? "" : "\n");
        printLevels(health.terrain, info.desiredTriangles);
    }
    printHealth(health);
    for (const std::string& line : info.reportLines) std::printf("note: %s\n", line.c_str());
}

}  // namespace

Result<void> runInfo(const std::filesystem::path& folder, bool json) {
    Result<Scene> scene = openScene(folder);
    if (!scene) return passOn(scene);
    const SceneHealth health = measureHealth(*scene);
    if (json) {
        printJson(*scene, health);
    } else {
        printTable(*scene, health);
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
