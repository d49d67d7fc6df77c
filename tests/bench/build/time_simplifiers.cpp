#include <algorithm>
#include <cstdio>

#include "base/clock.h"
#include "build/measure_error.h"
#include "commands.h"
#include "open_source.h"
#include "prepare_blocks.h"
#include "sample_distance.h"

namespace fb::bench {
namespace {

struct LevelRow {
    std::size_t triangles = 0, aim = 0, reached = 0, stuckNodes = 0;
    double seconds = 0.0, boundMetres = 0.0;
};

// Adds what level `l` of `block` gives; its leaves give none. `errors` by level and piece, in grid units.
void addBlock(PreparedBlock& block, std::size_t l, const BuildSettings& settings, std::size_t rounds,
              const std::vector<std::vector<double>>& errors, LevelRow& row) {
    const BlockLevel& level = block.levels[l];
    std::vector<std::size_t> aims;
    for (const Piece& piece : level.original.pieces) {
        aims.push_back(simplificationAim(piece.size(), level.factor));
        row.aim += aims.back();
    }
    double best = 0.0;
    for (std::size_t r = 0; r < rounds; ++r) {
        SteadyClock::time_point start = SteadyClock::now();
        const auto again = simplifyLevel(block.mesh, level.original, aims, settings.simplifier);
        const double seconds = secondsSinceLap(start);
        best = r == 0 ? seconds : std::min(best, seconds);
    }
    row.seconds += best;
    row.triangles += level.original.triangles.size();
    for (std::size_t i = 0; i < level.simplified.size(); ++i) {
        row.reached += level.simplified[i].triangles.size();
        row.stuckNodes += level.simplified[i].stuck ? 1 : 0;
        row.boundMetres = std::max(row.boundMetres, errors[l][i] * block.mesh.grid.step);
    }
}

struct Subject {
    const std::vector<SourceBlock>& blocks;
    glm::dvec3 centre;
    double diagonalMetres;
};

Result<void> timeOne(const Subject& subject, const char* name, const BuildSettings& settings,
                     const BenchOptions& options) {
    Result<std::vector<PreparedBlock>> blocks = prepareBlocks(subject.blocks, settings);
    if (!blocks) return failure({}, {}, blocks.error().oneLine());
    std::vector<LevelRow> rows(innerLevels(*blocks));
    for (PreparedBlock& block : *blocks) {
        const std::vector<std::vector<double>> errors = measureErrors(block.mesh, block.levels);
        for (std::size_t l = 0; l + 1 < block.levels.size(); ++l)
            addBlock(block, l, settings, options.rounds, errors, rows[l]);
    }
    const TriangleTree source(surfaceOfSource(*blocks, subject.centre).triangles);
    const double scale = 1e4 / subject.diagonalMetres;
    for (std::size_t l = 0; l < rows.size(); ++l) {
        const LevelRow& row = rows[l];
        const TriangleTree level(surfaceOfLevel(*blocks, l, subject.centre).triangles);
        const TwoSided sampled = compareSurfaces(source, level, options.samples);
        std::printf("%-14s %5zu %9zu %9zu %9zu %6zu %11.0f %8.2f %8.3f %8.2f %8.3f %8.2f\n", name, l,
                    row.triangles, row.aim, row.reached, row.stuckNodes,
                    static_cast<double>(row.triangles) / row.seconds, scale * row.boundMetres,
                    scale * sampled.toLevel.mean, scale * sampled.toLevel.largest,
                    scale * sampled.toSource.mean, scale * sampled.toSource.largest);
    }
    return {};
}

}  // namespace

Result<void> timeSimplifiers(const BenchOptions& options) {
    Result<std::unique_ptr<BlockSource>> source = openSource(options);
    if (!source) return passOn(source);
    Result<std::vector<SourceBlock>> blocks = loadBlocks(**source);
    if (!blocks) return passOn(blocks);
    const SourceInfo& info = (*source)->info();
    const Subject subject{*blocks, info.bounds.centre(), info.bounds.diagonal()};
    std::printf("simplifiers: %s, %zu blocks, diagonal %.4g m; distances in 1/10000 of it\n",
                info.name.c_str(), blocks->size(), subject.diagonalMetres);
    std::printf("(bound: largest of the nodes' own errors; -> level, -> source: %zu samples a direction)\n",
                options.samples);
    std::printf("%-14s %5s %9s %9s %9s %6s %11s %8s %8s %8s %8s %8s\n", "simplifier", "level", "triangles",
                "aim", "reached", "stuck", "triangles/s", "bound", "->l mean", "->l max", "->s mean",
                "->s max");
    BuildSettings settings = options.settings.build;
    settings.simplifier = Simplifier::meshoptimizer;
    if (Result<void> done = timeOne(subject, "meshoptimizer", settings, options); !done) return done;
    settings.simplifier = Simplifier::openMesh;
    BenchOptions once = options;
    once.rounds = 1;
    return timeOne(subject, "openmesh", settings, once);
}

}  // namespace fb::bench
