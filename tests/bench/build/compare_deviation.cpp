#include <algorithm>
#include <cstdio>

#include "commands.h"
#include "open_source.h"
#include "prepare_blocks.h"
#include "sample_distance.h"
#include "simplify_plainly.h"
#include "tell_deviation.h"

namespace fb::bench {
namespace {

constexpr double kLargestRatio = 1.1;  // ours may deviate by a tenth more than plain simplification
constexpr double kLargestShare = 0.5;  // of the source's triangles: that is asked of levels up to here

class DeviationTable {
  public:
    DeviationTable(const std::vector<PreparedBlock>& blocks, const std::vector<SourceBlock>& sources,
                   const Box3d& bounds, std::size_t samples)
        : blocks_(blocks),
          whole_(weldBlocks(sources, bounds.centre())),
          centre_(bounds.centre()),
          scale_(1e4 / bounds.diagonal()),
          samples_(samples),
          source_(surfaceOfSource(blocks, centre_)),
          sourceTree_(source_.triangles) {
        for (const PreparedBlock& block : blocks)
            single_.push_back(weldBlocks({&sources[block.source], 1}, centre_));
    }

    void print() {
        std::printf("%5s %6s %-9s %9s %7s %8s %8s %8s %8s\n", "level", "nodes", "", "triangles", "share",
                    "->l mean", "->l max", "->s mean", "->s max");
        for (std::size_t l = 0; l < innerLevels(blocks_); ++l) printLevel(l);
        std::printf("%s\n", missed_ == 0 ? "no level deviates by more than a tenth more than plain"
                                         : "levels marked * deviate by more than a tenth more than plain");
    }

  private:
    void printLevel(std::size_t l) {
        const NodeSurface drawn = surfaceOfLevel(blocks_, l, centre_);
        std::size_t nodes = 0;
        for (const PreparedBlock& block : blocks_)
            nodes += block.levels[block.levelFor(l)].original.pieces.size();
        std::printf("%5zu %6zu ", l, nodes);
        const TwoSided ours = printSurface("ours", drawn.triangles);
        std::printf("%13s", "");
        const TwoSided plain =
            printSurface("plain", whole_.cornersOf(simplifyPlainly(whole_, drawn.triangles.size())));
        std::printf("%13s", "");
        printSurface("by block", simplifyByBlock(drawn));
        const double mean = ours.mean() / plain.mean(), largest = ours.largest() / plain.largest();
        const bool isMissed =
            shareOf(drawn.triangles.size()) <= kLargestShare && std::max(mean, largest) > kLargestRatio;
        missed_ += isMissed ? 1 : 0;
        std::printf("%13s%-9s %9s %7s %8.3f %8.3f %8.3f %8.3f   worse way: mean %.3f, max %.3f%s\n", "",
                    "ratio", "", "", ours.toLevel.mean / plain.toLevel.mean,
                    ours.toLevel.largest / plain.toLevel.largest, ours.toSource.mean / plain.toSource.mean,
                    ours.toSource.largest / plain.toSource.largest, mean, largest, isMissed ? " *" : "");
        tellDeviation({blocks_, centre_, scale_, l, source_, drawn}, ours);
    }

    [[nodiscard]] double shareOf(std::size_t triangles) const {
        return static_cast<double>(triangles) / static_cast<double>(whole_.triangles());
    }

    TwoSided printSurface(const char* what, std::vector<TriangleCorners> triangles) const {
        const std::size_t count = triangles.size();
        const TwoSided d = compareSurfaces(sourceTree_, TriangleTree(std::move(triangles)), samples_);
        std::printf("%-9s %9zu %6.2f%% %8.3f %8.3f %8.3f %8.3f\n", what, count, 100.0 * shareOf(count),
                    scale_ * d.toLevel.mean, scale_ * d.toLevel.largest, scale_ * d.toSource.mean,
                    scale_ * d.toSource.largest);
        return d;
    }

    // Each block to as many triangles as ours has there: what is left of the difference is not the share of
    // each block.
    [[nodiscard]] std::vector<TriangleCorners> simplifyByBlock(const NodeSurface& drawn) const {
        std::vector<std::size_t> counts(blocks_.size(), 0);
        for (const TriangleOrigin& origin : drawn.origins) ++counts[origin.block];
        std::vector<TriangleCorners> result;
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const std::vector<TriangleCorners> one =
                single_[b].cornersOf(simplifyPlainly(single_[b], counts[b]));
            result.insert(result.end(), one.begin(), one.end());
        }
        return result;
    }

    const std::vector<PreparedBlock>& blocks_;
    WeldedMesh whole_;
    std::vector<WeldedMesh> single_;  // by block
    glm::dvec3 centre_;
    double scale_;
    std::size_t samples_;
    NodeSurface source_;
    TriangleTree sourceTree_;
    int missed_ = 0;
};

}  // namespace

Result<void> compareDeviation(const BenchOptions& options) {
    Result<std::unique_ptr<BlockSource>> source = openSource(options);
    if (!source) return passOn(source);
    Result<std::vector<SourceBlock>> blocks = loadBlocks(**source);
    if (!blocks) return passOn(blocks);
    Result<std::vector<PreparedBlock>> prepared = prepareBlocks(*blocks, options.settings.build);
    if (!prepared) return passOn(prepared);
    const SourceInfo& info = (*source)->info();
    std::printf("deviation: %s in %zu blocks, diagonal %.4g m; lengths in 1/10000 of it\n", info.name.c_str(),
                blocks->size(), info.bounds.diagonal());
    std::printf(
        "(plain: one meshopt_simplify of the welded whole to as many triangles; by block: one for each block "
        "to "
        "as many as it has there; %zu samples a direction)\n",
        options.samples);
    DeviationTable(*prepared, *blocks, info.bounds, options.samples).print();
    return {};
}

}  // namespace fb::bench
