// Random scenes without content, a loader and a device that fail at random, and random walks: for properties.
#pragma once

#include <set>

#include "base/random.h"
#include "tiny_world.h"

namespace fb::test {

inline Box3f randomBoxIn(const Box3f& outer, Random& random) {
    Box3f box;
    for (int i = 0; i < 2; ++i) {
        box.grow(outer.min + (outer.max - outer.min) * glm::vec3(static_cast<float>(random.uniform()),
                                                                 static_cast<float>(random.uniform()),
                                                                 static_cast<float>(random.uniform())));
    }
    return box;
}

// One to four roots, up to five levels, one to five children a node. Sizes of some kilobytes, or of some
// megabytes so that the window of loads in flight matters too.
inline Scene randomScene(Random& random) {
    std::vector<NodeSpec> specs;
    const std::uint64_t scale = random.index(2) == 0 ? 10'000 : 4'000'000;
    const auto bytes = [&] { return static_cast<std::uint32_t>(1 + random.index(scale)); };
    for (std::uint64_t roots = 1 + random.index(4); roots > 0; --roots)
        specs.push_back({kNoNode, 1, bytes()});
    std::vector<int> depth(specs.size(), 0);
    for (NodeId n = 0; n < specs.size(); ++n) {
        if (depth[n] >= 4 || (depth[n] > 0 && random.index(3) == 0) || specs.size() > 150) continue;
        for (std::uint64_t children = 1 + random.index(5); children > 0; --children) {
            specs.push_back({n, 1, bytes()});
            depth.push_back(depth[n] + 1);
        }
    }
    Scene scene;
    Hierarchy& h = scene.hierarchy = makeHierarchy(specs);
    for (NodeId n = 0; n < h.size(); ++n) {
        h.bounds[n] = n < h.rootCount ? Box3f{{-100, -100, -100}, {100, 100, 100}}
                                      : randomBoxIn(h.bounds[h.parent[n]], random);
        h.texturedTriangles[n] = static_cast<std::uint32_t>(random.index(1000));
        h.staticBenefit[n] = random.index(10) == 0 ? 0.0f : static_cast<float>(random.uniform(0.0, 1000.0));
        const glm::dvec3 normal(random.normal(), random.normal(), random.normal());
        h.averageNormal[n] = glm::vec3(glm::normalize(normal));
        h.payload[n] = {static_cast<std::uint32_t>(random.index(3)), random.index(1'000'000),
                        static_cast<std::uint32_t>(1 + random.index(200'000)), 0};
    }
    return scene;
}

inline View randomView(Random& random) {
    const auto point = [&](double size) {
        return size * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    return makeView(lookAt(point(200), point(100), {0, 1, 0}), point(10), 640, 480);
}

// Every load and every upload fails with the given probability.
struct FlakyLoader final : Loader {
    std::unique_ptr<Loader> loader;
    Random random;
    double faultRate;

    FlakyLoader(std::unique_ptr<Loader> l, std::uint64_t seed, double rate)
        : loader(std::move(l)), random(seed), faultRate(rate) {}
    void publish(std::span<const Wish> wishes, const LoadSettings& settings) override {
        loader->publish(wishes, settings);
    }
    bool take(FinishedLoad& finished, std::uint64_t capBytes) override {
        if (!loader->take(finished, capBytes)) return false;
        if (random.uniform() < faultRate) finished.content = failure("disk", {}, "EIO");
        return true;
    }
    void advance(double seconds) override { loader->advance(seconds); }
    LoaderCounters counters() const override { return loader->counters(); }
    double nowSeconds() const override { return loader->nowSeconds(); }
};

struct FlakyDevice final : NodeDevice {
    Random random;
    double faultRate;
    std::set<NodeId> stored;

    FlakyDevice(std::uint64_t seed, double rate) : random(seed), faultRate(rate) {}
    Result<void> upload(NodeId node, const DecodedNode&) override {
        if (random.uniform() < faultRate) return failure("GPU", {}, "out of memory");
        if (!stored.insert(node).second) std::abort();
        return {};
    }
    void release(NodeId node) override {
        if (stored.erase(node) != 1) std::abort();
    }
};

}  // namespace fb::test
