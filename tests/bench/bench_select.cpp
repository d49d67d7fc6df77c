// What selecting costs: microseconds a frame and nanoseconds a visited node, for each policy on hierarchies
// of 2,310, 99,645 and 999,363 nodes. The front is held at a similar size (target, share time or pixel threshold are chosen
// for about 400 nodes), so that a policy shows whether a frame costs in proportion to what it visits and not to what
// there is (thesis 5.2); coarse and full draw what they draw. Run in a release build: bench_select --benchmark_format=console
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "base/check.h"
#include "base/random.h"
#include "select/select.h"

namespace {

using namespace fb;

// `side * side` blocks of 20 m on a grid, each a full tree with four children a node. Depth, cost and benefit
// vary by seeded noise so that no two nodes are alike.
Hierarchy cityBlocks(std::uint32_t roots, int levels) {
    Hierarchy h;
    h.rootCount = roots;
    Random random(1);
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(roots))));
    std::uint64_t nodes = 0, inLevel = roots;
    for (int level = 0; level < levels; ++level, inLevel *= 4) nodes += inLevel;
    h.resize(nodes);
    NodeId next = roots;
    for (NodeId n = 0; n < nodes; ++n) {
        if (n < roots) {
            const glm::vec3 low(20.0f * static_cast<float>(n % side), 0.0f,
                                -20.0f * static_cast<float>(n / side));
            h.bounds[n] = {low, low + glm::vec3(18.0f, static_cast<float>(random.uniform(8.0, 30.0)), 18.0f)};
            h.block[n] = n;
        }
        h.texturedTriangles[n] = 600 + static_cast<std::uint32_t>(random.index(600));
        const glm::vec3 size = h.bounds[n].size();
        const float area = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
        h.staticBenefit[n] = std::sqrt(static_cast<float>(h.texturedTriangles[n]) * area);
        h.averageNormal[n] = glm::vec3(0.0f, 0.0f, 1.0f);
        h.areaSquareMetres[n] = area;
        h.geometricErrorMetres[n] = h.level[n] + 1 == levels ? 0.0f : 2.0f / static_cast<float>(1 << h.level[n]);
        if (h.level[n] + 1 == levels) continue;
        h.firstChild[n] = next;
        h.childCount[n] = 4;
        for (int i = 0; i < 4; ++i, ++next) {
            h.parent[next] = n;
            h.level[next] = static_cast<std::uint8_t>(h.level[n] + 1);
            h.block[next] = h.block[n];
            Box3f box = h.bounds[n];
            const int a = box.longestAxis();
            const int b = (a + 1) % 3;
            (i % 2 == 0 ? box.max : box.min)[a] = box.centre()[a];
            (i / 2 == 0 ? box.max : box.min)[b] = box.centre()[b];
            h.bounds[next] = box;
        }
    }
    FB_CHECK(next == nodes);
    return h;
}

const Hierarchy& world(std::int64_t nodes) {
    static std::map<std::int64_t, Hierarchy> worlds;
    const auto found = worlds.find(nodes);
    if (found != worlds.end()) return found->second;
    // 110 blocks of 3 levels, 73 of 6, 183 of 7.
    Hierarchy made = nodes == 2310    ? cityBlocks(110, 3)
                     : nodes == 99645 ? cityBlocks(73, 6)
                                      : cityBlocks(183, 7);
    FB_CHECK(static_cast<std::int64_t>(made.size()) == nodes);
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
    constexpr double kWantedNodes = 400.0;
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
    // The share time that gives about the wanted front, as the second feedback loop would find it.
    for (int i = 0; i < 1500; ++i) {
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
    bench->Arg(2310)->Arg(99645)->Arg(999363)->Unit(benchmark::kMicrosecond);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const Policy& policy : policies())
        sizes(benchmark::RegisterBenchmark(std::string(policy.name).c_str(), selecting, policy.id));
    return true;
}();

}  // namespace
