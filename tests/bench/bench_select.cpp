// What selecting costs: microseconds a frame and nanoseconds a visited node, for each policy on hierarchies of 2,310,
// about 100,000 and about 1,000,000 nodes: the same blocks and the same first three levels, divided further. The front is
// held at a similar size (target, share time or pixel threshold are chosen for about 150 nodes), so that a policy shows
// whether a frame costs in proportion to what it visits and not to what there is (thesis 5.2); coarse and full draw what
// they draw. Run in a release build: bench_select --benchmark_format=console
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "base/check.h"
#include "base/random.h"
#include "select/select.h"

namespace {

using namespace fb;

constexpr std::uint32_t kRoots = 110;

// How a block of 20 m is divided: levels of four children a node, and below the last of them one level of `leastLeaves`
// children a node or one more, by turns as `moreLeaves` of 8 says; 0: no such level.
struct Division {
    int levels;
    std::uint32_t leastLeaves, moreLeaves;
};

std::uint32_t childrenOf(const Division& division, int level, std::uint32_t node) {
    if (level + 1 < division.levels) return 4;
    if (level + 1 > division.levels || division.leastLeaves == 0) return 0;
    return division.leastLeaves + (node % 8 < division.moreLeaves ? 1 : 0);
}

// A part of a box: cut by two in two directions for the first four children, and in the third for those after them.
Box3f partOf(Box3f box, std::uint32_t part) {
    const int a = box.longestAxis(), b = (a + 1) % 3, c = (a + 2) % 3;
    const glm::vec3 centre = box.centre();
    (part % 2 == 0 ? box.max : box.min)[a] = centre[a];
    (part / 2 % 2 == 0 ? box.max : box.min)[b] = centre[b];
    if (part >= 4) box.min[c] = centre[c];
    return box;
}

// The blocks lie on a grid. Cost and benefit vary by seeded noise so that no two nodes are alike.
Hierarchy cityBlocks(const Division& division) {
    Hierarchy h;
    h.rootCount = kRoots;
    h.resize(kRoots);
    Random random(1);
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(kRoots))));
    for (NodeId n = 0; n < kRoots; ++n) {
        const glm::vec3 low(20.0f * static_cast<float>(n % side), 0.0f, -20.0f * static_cast<float>(n / side));
        h.bounds[n] = {low, low + glm::vec3(18.0f, static_cast<float>(random.uniform(8.0, 30.0)), 18.0f)};
        h.block[n] = n;
    }
    for (NodeId n = 0; n < h.size(); ++n) {
        const std::uint32_t children = childrenOf(division, h.level[n], n);
        const auto first = static_cast<NodeId>(h.size());
        h.resize(first + children);
        h.texturedTriangles[n] = 600 + static_cast<std::uint32_t>(random.index(600));
        const glm::vec3 size = h.bounds[n].size();
        const float area = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
        h.staticBenefit[n] = std::sqrt(static_cast<float>(h.texturedTriangles[n]) * area);
        h.averageNormal[n] = glm::vec3(0.0f, 0.0f, 1.0f);
        h.areaSquareMetres[n] = area;
        h.geometricErrorMetres[n] = children == 0 ? 0.0f : 2.0f / static_cast<float>(1 << h.level[n]);
        if (children == 0) continue;
        h.firstChild[n] = first;
        h.childCount[n] = children;
        for (std::uint32_t i = 0; i < children; ++i) {
            h.parent[first + i] = n;
            h.level[first + i] = static_cast<std::uint8_t>(h.level[n] + 1);
            h.block[first + i] = h.block[n];
            h.bounds[first + i] = partOf(h.bounds[n], i);
        }
    }
    return h;
}

const Hierarchy& world(std::int64_t nodes) {
    static std::map<std::int64_t, Hierarchy> worlds;
    const auto found = worlds.find(nodes);
    if (found != worlds.end()) return found->second;
    const Division division = nodes == 2310 ? Division{3, 0, 0} : nodes == 100000 ? Division{5, 2, 2} : Division{6, 7, 4};
    Hierarchy made = cityBlocks(division);
    FB_CHECK(std::abs(static_cast<double>(made.size()) / static_cast<double>(nodes) - 1.0) < 0.02);
    return worlds.emplace(nodes, std::move(made)).first->second;
}

void selecting(benchmark::State& bench, PolicyId policy) {
    const Hierarchy& hierarchy = world(bench.range(0));
    SelectSettings settings;
    settings.policy = policy;
    ActiveEffects effects;
    effects.on.fill(true);
    const std::vector<std::uint8_t> loaded(hierarchy.size(), 1), refused(hierarchy.size(), 0);
    SelectState state;
    state.reset(hierarchy, settings);
    Selection selection;
    constexpr double kVTimeMs = 1e-4;
    constexpr double kWantedNodes = 150.0;
    double shareMs = kWantedNodes * 450.0 * kVTimeMs;
    const double targetMs = shareMs;
    MeasuredFront measured;
    std::uint64_t frame = 0, visited = 0, drawn = 0;
    const auto step = [&] {
        ++frame;
        const double turn = 0.3 * std::sin(0.002 * static_cast<double>(frame));
        const Camera camera = lookAt({90, 12, 40}, {90 + 100 * turn, 5, -100}, {0, 1, 0});
        const View view = makeView(camera, {0, 0, -1.4}, 1280, 720);
        const TimeModel time = timesByCost(kVTimeMs, settings.cTextured, 0.0);
        selectFront({hierarchy, loaded, refused, view, settings, effects, time, shareMs, targetMs, 1.0 / 30.0, frame,
                     measured},
                    state, selection);
        measured = {selection.triangles, selection.estimateMs};
    };
    // The front settles, and what has to be found for it to have the wanted size is found, as the second feedback loop
    // would; to the others the target says it.
    const bool isTuned = policyOf(policy).usesShareTime || policy == PolicyId::screenError;
    for (int i = 0; i < (isTuned ? 1500 : 100); ++i) {
        step();
        const bool isTooSmall = static_cast<double>(selection.front.size()) < kWantedNodes;
        if (policyOf(policy).usesShareTime) shareMs *= isTooSmall ? 1.01 : 0.99;
        if (policy == PolicyId::screenError) settings.pixelThreshold *= isTooSmall ? 0.99 : 1.01;
    }
    for (auto iteration : bench) {
        (void)iteration;
        step();
        visited += selection.counters.visited;
        drawn += selection.front.size();
        benchmark::DoNotOptimize(selection.front.data());
    }
    const auto frames = static_cast<double>(bench.iterations());
    bench.counters["front"] = static_cast<double>(drawn) / frames;
    bench.counters["visited"] = static_cast<double>(visited) / frames;
    // Seconds for one visited node; the console shows it as nanoseconds ("n").
    bench.counters["perNode"] = benchmark::Counter(static_cast<double>(visited),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void sizes(benchmark::internal::Benchmark* bench) {
    bench->Arg(2310)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMicrosecond);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const Policy& policy : policies())
        sizes(benchmark::RegisterBenchmark(std::string(policy.name).c_str(), selecting, policy.id));
    return true;
}();

}  // namespace
