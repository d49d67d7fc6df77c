// Counting what was built (build_scene.h).
#include <algorithm>

#include "build/build_scene.h"

namespace fb {

void BuildPhases::add(const BuildPhases& other) {
    for (const NamedPhase& phase : kBuildPhases) this->*phase.seconds += other.*phase.seconds;
}

void BuildReport::add(BuildReport&& part) {
    phases.add(part.phases);
    for (std::uint64_t BuildReport::*count :
         {&BuildReport::blocks, &BuildReport::reusedBlocks, &BuildReport::nodes, &BuildReport::emptyPieces,
          &BuildReport::stuckNodes, &BuildReport::sourceTriangles, &BuildReport::leafTriangles}) {
        this->*count += part.*count;
    }
    sourceAreaSquareMetres += part.sourceAreaSquareMetres;
    leafAreaSquareMetres += part.leafAreaSquareMetres;
    for (std::string& line : part.warnings) {
        if (std::ranges::find(warnings, line) == warnings.end()) warnings.push_back(std::move(line));
    }
}

BuildReport countsOf(const BuiltBlock& block) {
    BuildReport report;
    report.blocks = 1;
    report.nodes = block.nodes.size();
    report.sourceTriangles = block.sourceTriangles;
    report.sourceAreaSquareMetres = block.sourceAreaSquareMetres;
    for (const BuiltNode& node : block.nodes) {
        report.stuckNodes += node.stuck ? 1 : 0;
        if (node.childCount > 0) continue;
        report.leafTriangles +=
            std::uint64_t{node.texturedTriangles} + node.untexturedTriangles - node.skirtTriangles;
        report.leafAreaSquareMetres += static_cast<double>(node.areaSquareMetres);
    }
    return report;
}

}  // namespace fb
