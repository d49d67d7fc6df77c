#include "tell_deviation.h"

#include <algorithm>
#include <cstdio>

#include "find_components.h"

namespace fb::bench {
namespace {

bool touchesCut(const PreparedBlock& block, const Piece& piece, const glm::uvec3& positions) {
    return std::ranges::any_of(piece.cuts, [&](const CutPlane& plane) {
        return block.mesh.positions[positions.x][plane.axis] == plane.at ||
               block.mesh.positions[positions.y][plane.axis] == plane.at ||
               block.mesh.positions[positions.z][plane.axis] == plane.at;
    });
}

bool touchesOtherBlock(const PreparedBlock& block, const glm::uvec3& positions) {
    return block.mesh.isOnBlockBorder(positions.x) || block.mesh.isOnBlockBorder(positions.y) ||
           block.mesh.isOnBlockBorder(positions.z);
}

void tellNode(const MeasuredLevel& measured, const TriangleOrigin& origin) {
    const PreparedBlock& block = measured.blocks[origin.block];
    const std::size_t own = block.levelFor(measured.level);
    const Piece& original = block.levels[own].original.pieces[origin.piece];
    std::printf("node %u of \"%s\", level %zu, %u", origin.piece, block.name.c_str(), own, original.size());
    if (!block.levels[own].isLeaves()) {
        const SimplifiedPiece& piece = block.levels[own].simplified[origin.piece];
        std::printf(" -> %zu triangles%s%s%s", piece.triangles.size(), piece.welded ? ", welded" : "",
                    piece.clustered ? ", clustered" : "", piece.stuck ? ", stuck" : "");
    }
    std::printf("%s%s", touchesCut(block, original, origin.positions) ? ", at a cut" : "",
                touchesOtherBlock(block, origin.positions) ? ", at another block" : "");
}

void tellPart(const MeasuredLevel& measured, const TriangleOrigin& from) {
    const Components components(measured.blocks[from.block]);
    const std::uint32_t part = components.of(from.positions.x);
    const std::size_t left = components.drawnTriangles(measured.level)[part];
    const char* gone = components.isStoodFor(part, measured.level) ? "has a stand-in" : "vanished";
    std::printf("part of %zu triangles, %.1f long, %s; ", components.sourceTriangles(part),
                measured.scale * components.longestSideMetres(part),
                left == 0 ? gone : (std::to_string(left) + " left").c_str());
}

void tellPlace(const MeasuredLevel& measured, const SampledDistance& d) {
    const glm::dvec3 at = measured.centre + glm::dvec3(d.worst);
    std::printf("; at (%.6g, %.6g, %.6g)\n", at.x, at.y, at.z);
}

void tellVanished(const MeasuredLevel& measured) {
    VanishedParts all;
    for (const PreparedBlock& block : measured.blocks) {
        const VanishedParts here = Components(block).vanishedAt(measured.level);
        all.parts += here.parts;
        all.stoodFor += here.stoodFor;
        all.vanished += here.vanished;
        all.triangles += here.triangles;
    }
    std::printf("        of %zu connected parts %zu have stand-ins, %zu vanished, with %zu triangles of the source\n",
                all.parts, all.stoodFor, all.vanished, all.triangles);
}

}  // namespace

void tellDeviation(const MeasuredLevel& measured, const TwoSided& distances) {
    tellVanished(measured);
    std::printf("        worst -> level:  ");
    tellPart(measured, measured.source.origins[distances.toLevel.from]);
    tellNode(measured, measured.drawn.origins[distances.toLevel.to]);
    tellPlace(measured, distances.toLevel);
    std::printf("        worst -> source: ");
    tellNode(measured, measured.drawn.origins[distances.toSource.from]);
    tellPlace(measured, distances.toSource);
}

}  // namespace fb::bench
