#include "measure/scene_health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fb {
namespace {

// From which on a warning is worth reading.
constexpr double kThinFill = 0.3, kFatFill = 2.0;
constexpr double kStuckShare = 0.02, kSkirtShare = 0.25, kUntexturedShare = 0.05;
constexpr double kUselessGain = 0.9;  // of the parents' mean error is left after refining
constexpr std::uint64_t kManyNodes = 8;

template <class... Values>
std::string print(const char* format, Values... values) {
    char text[320];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

double shareOf(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

struct Gathered {
    std::vector<LevelFacts> levels;
    std::vector<std::vector<std::uint32_t>> triangles;  // by level and node
};

Gathered gather(const Hierarchy& h, BlockKind kind) {
    Gathered result;
    for (NodeId n = 0; n < h.size(); ++n) {
        if (h.kinds[h.block[n]] != kind) continue;
        if (h.level[n] >= result.levels.size()) {
            result.levels.resize(h.level[n] + 1u);
            result.triangles.resize(h.level[n] + 1u);
        }
        LevelFacts& level = result.levels[h.level[n]];
        const std::uint32_t surface = h.triangles(n) - h.skirtTriangles[n];
        ++level.nodes;
        level.leaves += h.isLeaf(n) ? 1 : 0;
        level.stuckNodes += h.stuck[n];
        level.untexturedNodes += h.textureWidth[n] == 0 ? 1 : 0;
        level.texturedTriangles += h.texturedTriangles[n];
        level.untexturedTriangles += h.untexturedTriangles[n];
        level.skirtTriangles += h.skirtTriangles[n];
        level.mostTriangles = std::max<std::uint64_t>(level.mostTriangles, surface);
        level.texels += std::uint64_t{h.textureWidth[n]} * h.textureHeight[n];
        level.diskBytes += h.payload[n].sizeBytes;
        level.residentBytes += h.residentBytes[n];
        level.errorSumMetres += static_cast<double>(h.geometricErrorMetres[n]);
        level.errorMaxMetres = std::max(level.errorMaxMetres, static_cast<double>(h.geometricErrorMetres[n]));
        level.gapMaxMetres = std::max(level.gapMaxMetres, static_cast<double>(h.borderErrorMetres[n]));
        result.triangles[h.level[n]].push_back(surface);
    }
    return result;
}

std::vector<LevelFacts> levelsOf(const Scene& scene, BlockKind kind) {
    Gathered gathered = gather(scene.hierarchy, kind);
    const auto desired = static_cast<double>(scene.info.desiredTriangles);
    for (std::size_t l = 0; l < gathered.levels.size() && desired > 0.0; ++l) {
        std::vector<std::uint32_t>& counts = gathered.triangles[l];
        std::ranges::sort(counts);
        gathered.levels[l].fillLow = counts[counts.size() / 20] / desired;
        gathered.levels[l].fillHigh = counts[counts.size() - 1 - counts.size() / 20] / desired;
    }
    return std::move(gathered.levels);
}

class Doctor {
  public:
    Doctor(const Scene& scene, SceneHealth& health) : scene_(scene), health_(health) {}

    void examine() {
        const std::vector<LevelFacts>& levels = health_.objects;
        for (std::size_t l = 0; l < levels.size(); ++l) examineLevel(l, levels[l]);
        for (std::size_t l = 1; l < levels.size(); ++l) examineGain(l, levels[l - 1], levels[l]);
        if (levels.size() == 1 && levels[0].nodes > 0 && health_.terrain.empty()) {
            warn(print("every block is one node, and nothing can be selected: blocks of more than %llu triangles make "
                       "levels (--block-triangles, --split grid)",
                       number(scene_.info.desiredTriangles)));
        }
        if (health_.untexturedShare > kUntexturedShare && health_.untexturedShare < 1.0 - kUntexturedShare) {
            warn(print("%.0f %% of the leaves' triangles have no texture beside others that have: look in the notes of "
                       "the build for textures that are missing",
                       100.0 * health_.untexturedShare));
        }
    }

  private:
    static unsigned long long number(std::uint64_t value) { return value; }
    void warn(std::string line) { health_.warnings.push_back(std::move(line)); }

    void examineLevel(std::size_t l, const LevelFacts& level) {
        const bool isInner = level.leaves < level.nodes;
        if (shareOf(level.stuckNodes, level.nodes) > kStuckShare) {
            warn(print("level %zu: %llu of %llu nodes could not be simplified enough, up to %llu triangles in one: it costs "
                       "more time than it should; small parts that hold together (welded, or one object) simplify better",
                       l, number(level.stuckNodes), number(level.nodes), number(level.mostTriangles)));
        }
        const double fill = level.fill(scene_.info.desiredTriangles);
        if (level.nodes >= kManyNodes && fill > 0.0 && fill < kThinFill) {
            warn(print("level %zu: nodes hold %.0f %% of c_desiredTris on average: many small nodes cost selection and "
                       "drawing time; a smaller build.desired_triangles or larger blocks fit better",
                       l, 100.0 * fill));
        }
        if (level.nodes >= kManyNodes && fill > kFatFill && isInner) {
            warn(print("level %zu: nodes hold %.1f times c_desiredTris on average: coarse levels cost more time than "
                       "they should",
                       l, fill));
        }
        if (shareOf(level.skirtTriangles, level.triangles()) > kSkirtShare) {
            warn(print("level %zu: %.0f %% of the triangles are skirts: nodes are small for their borders; larger blocks or "
                       "a larger build.desired_triangles need fewer",
                       l, 100.0 * shareOf(level.skirtTriangles, level.triangles())));
        }
        if (isInner && level.untexturedNodes > 0 && level.untexturedNodes < level.nodes &&
            health_.objects.back().untexturedNodes == 0) {
            warn(print("level %zu: %llu of %llu nodes lost their texture: they have too many texture parts for "
                       "build.max_texture_side; a larger one keeps them",
                       l, number(level.untexturedNodes), number(level.nodes)));
        }
    }

    void examineGain(std::size_t l, const LevelFacts& coarse, const LevelFacts& fine) {
        if (fine.leaves == fine.nodes || coarse.meanError() <= 0.0) return;
        if (fine.meanError() > kUselessGain * coarse.meanError()) {
            warn(print("refining from level %zu to %zu takes only %.0f %% of the mean error away: small parts are missing "
                       "in both; they come back at the level below",
                       l - 1, l, 100.0 * (1.0 - fine.meanError() / coarse.meanError())));
        }
    }

    const Scene& scene_;
    SceneHealth& health_;
};

}  // namespace

double LevelFacts::fill(std::uint64_t desiredTriangles) const {
    if (nodes == 0 || desiredTriangles == 0) return 0.0;
    return static_cast<double>(triangles() - skirtTriangles) / static_cast<double>(nodes) / static_cast<double>(desiredTriangles);
}

SceneHealth measureHealth(const Scene& scene) {
    const Hierarchy& h = scene.hierarchy;
    SceneHealth health;
    health.objects = levelsOf(scene, BlockKind::objects);
    health.terrain = levelsOf(scene, BlockKind::terrain);
    health.depth = std::max<std::size_t>({health.objects.size(), health.terrain.size(), 1}) - 1;
    std::uint64_t leafTriangles = 0, untextured = 0;
    for (NodeId n = 0; n < h.size(); ++n) {
        if (n < h.rootCount) health.rootBytes += h.residentBytes[n];
        if (h.parent[n] != kNoNode && h.geometricErrorMetres[n] > h.geometricErrorMetres[h.parent[n]])
            health.errorIsMonotone = false;
        if (h.isLeaf(n)) {
            leafTriangles += h.triangles(n);
            untextured += h.untexturedTriangles[n];
        } else if (!h.isTerrain(n) && scene.info.levelFactor > h.childCount[n]) {
            health.emptyPieces += scene.info.levelFactor - h.childCount[n];
        }
    }
    health.untexturedShare = shareOf(untextured, leafTriangles);
    Doctor(scene, health).examine();
    return health;
}

}  // namespace fb
