// load_throughput SCENE [KNOB=VALUE ...]: how fast the loader brings a whole scene into memory, as a share of what a plain
// loop does that reads and decodes the same payloads one after the other as they lie on disk. By turns, in one run; the
// median of three rounds each. The main thread takes loads and plans 60 times a second, as a frame would, without uploading.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <string_view>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "load/decode_payload.h"
#include "load/loader.h"
#include "settings/knob_table.h"

namespace {

using namespace fb;

constexpr int kRounds = 3;
constexpr double kFrameMs = 1000.0 / 60.0;

double plainLoopMs(const Scene& scene) {
    const Hierarchy& h = scene.hierarchy;
    std::vector<NodeId> order(h.size());
    std::iota(order.begin(), order.end(), NodeId{0});
    std::ranges::sort(order, [&](NodeId a, NodeId b) {
        return std::pair(h.payload[a].pack, h.payload[a].offset) < std::pair(h.payload[b].pack, h.payload[b].offset);
    });
    ScenePacks packs(scene);
    const SteadyClock::time_point begun = SteadyClock::now();
    for (const NodeId node : order) {
        if (node < h.rootCount) continue;  // loaded before the first frame
        if (Result<std::unique_ptr<DecodedNode>> content = readAndDecode(scene, packs, node); !content) {
            std::fprintf(stderr, "load_throughput: %s\n", content.error().oneLine().c_str());
            std::exit(1);
        }
    }
    return millisecondsSince(begun);
}

double loaderMs(const Scene& scene, const Settings& settings) {
    NullDevice device;
    Residency residency;
    residency.reset(scene.hierarchy);
    if (!loadRoots(scene, device, residency, false)) std::exit(1);
    const std::unique_ptr<Loader> loader = startLoaderThread(scene);
    Camera camera;
    camera.eye = scene.info.bounds.centre();
    const View view = makeView(camera, glm::dvec3(0.0), 1280, 720);
    LoadPlan plan;
    const SteadyClock::time_point begun = SteadyClock::now();
    for (int frame = 1; !plan.everythingLoaded; ++frame) {
        const double now = millisecondsSince(begun) / 1000.0;
        takeFinishedLoads({scene.hierarchy, settings.load, now, {}}, *loader, device, residency);
        planLoads({scene.hierarchy, view, settings.select, settings.load, {}, {}, now}, residency, plan);
        loader->publish(plan.wishes, settings.load);
        if (plan.everythingLoaded) break;
        std::this_thread::sleep_until(begun + std::chrono::duration_cast<SteadyClock::duration>(
                                                  std::chrono::duration<double, std::milli>(frame * kFrameMs)));
    }
    if (residency.resident.size() != scene.hierarchy.size()) {
        std::fprintf(stderr, "load_throughput: %zu of %u nodes are in memory: give load.budget more\n",
                     residency.resident.size(), scene.hierarchy.size());
        std::exit(1);
    }
    return millisecondsSince(begun);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2 || std::strcmp(arguments[1], "--help") == 0) {
        std::puts("load_throughput SCENE [KNOB=VALUE ...]");
        return count < 2 ? 2 : 0;
    }
    Settings settings;
    settings.load.budgetMiB = 16384.0;
    for (int i = 2; i < count; ++i) {
        const std::string_view text = arguments[i];
        const std::size_t sign = std::min(text.find('='), text.size());
        const std::string_view value = text.substr(std::min(sign + 1, text.size()));
        if (Result<void> set = setFromText(settings, text.substr(0, sign), value, "argument"); !set) {
            std::fprintf(stderr, "load_throughput: %s\n", set.error().oneLine().c_str());
            return 2;
        }
    }
    const Result<Scene> scene = openScene(arguments[1]);
    if (!scene) {
        std::fprintf(stderr, "load_throughput: %s\n", scene.error().oneLine().c_str());
        return 1;
    }
    double payloadMB = 0.0;
    for (NodeId n = scene->hierarchy.rootCount; n < scene->hierarchy.size(); ++n) {
        payloadMB += scene->hierarchy.payload[n].sizeBytes / 1e6;
    }
    std::vector<double> plain, loader;
    for (int round = 0; round < kRounds; ++round) {
        plain.push_back(plainLoopMs(*scene));
        loader.push_back(loaderMs(*scene, settings));
    }
    const double plainMs = median(plain), loadMs = median(loader);
    std::printf("%u nodes, %.1f MB of payloads\nplain loop %8.1f MB/s\nloader     %8.1f MB/s, %.0f %% of it\n",
                scene->hierarchy.size() - scene->hierarchy.rootCount, payloadMB, payloadMB / plainMs * 1e3,
                payloadMB / loadMs * 1e3, plainMs / loadMs * 100.0);
}
