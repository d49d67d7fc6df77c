#include <set>

#include "import/source_scene.h"

namespace fb {
namespace {

constexpr std::size_t kMostWarnings = 100;

void tell(std::vector<std::string>& lines, std::uint64_t count, const char* one, const char* many) {
    if (count > 0) lines.push_back(std::to_string(count) + " " + (count == 1 ? one : many));
}

}  // namespace

void ImportReport::add(const ImportReport& other) {
    sourceTriangles += other.sourceTriangles;
    keptTriangles += other.keptTriangles;
    weldedVertices += other.weldedVertices;
    degenerateTriangles += other.degenerateTriangles;
    duplicateTriangles += other.duplicateTriangles;
    droppedVertices += other.droppedVertices;
    repairedAttributes += other.repairedAttributes;
    ignoredElements += other.ignoredElements;
    std::set<std::string> told(warnings.begin(), warnings.end());
    for (const std::string& warning : other.warnings) {
        if (told.insert(warning).second) warnings.push_back(warning);
    }
}

std::vector<std::string> ImportReport::lines() const {
    std::vector<std::string> lines;
    tell(lines, degenerateTriangles, "triangle without area was dropped",
         "triangles without area were dropped");
    tell(lines, duplicateTriangles, "triangle that was there twice was dropped",
         "triangles that were there already were dropped");
    tell(lines, weldedVertices, "vertex was joined with an equal one",
         "vertices were joined with equal ones");
    tell(lines, droppedVertices, "vertex that no triangle uses was dropped",
         "vertices that no triangle uses were dropped");
    tell(lines, repairedAttributes, "normal or texture coordinate that was not finite was set to 0",
         "normals or texture coordinates that were not finite were set to 0");
    tell(lines, ignoredElements, "point, line or face of fewer than 3 corners was left out",
         "points, lines or faces of fewer than 3 corners were left out");
    for (std::size_t i = 0; i < warnings.size() && i < kMostWarnings; ++i) lines.push_back(warnings[i]);
    if (warnings.size() > kMostWarnings) {
        lines.push_back("and " + std::to_string(warnings.size() - kMostWarnings) + " more of this kind");
    }
    return lines;
}

}  // namespace fb
