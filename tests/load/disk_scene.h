// A small scene on disk, written with the real writer: per block a root with four children of four children
// each.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <map>

#include "payload_world.h"
#include "scenefile/scene.h"

namespace fb::test {

inline constexpr std::uint32_t kNodesPerBlock = 1 + 4 + 16;

inline BuiltNode recordOfStrip(const NodeData& data, std::uint32_t index) {
    BuiltNode node;
    node.parentInBlock = index == 0 ? 0 : (index - 1) / 4;
    node.childCount = index < 5 ? 4 : 0;
    node.level = index == 0 ? 0 : index < 5 ? 1 : 2;
    node.bounds = {{0, 0, 0}, {1000, 1000, 1}};
    node.untexturedTriangles = data.mesh.untexturedTriangles;
    node.vertices = static_cast<std::uint32_t>(data.mesh.vertices.size());
    node.staticBenefit = static_cast<float>(100 - index);
    node.areaSquareMetres = 1;
    return node;
}

// Node i of each block has 10 + i triangles, times `size`.
inline Scene writeDiskScene(const std::filesystem::path& folder, std::uint32_t blockCount,
                            std::uint32_t size = 1) {
    std::vector<BuiltBlock> blocks(blockCount);
    for (std::uint32_t b = 0; b < blockCount; ++b) {
        PackWriter pack = PackWriter::create(folder, b).value();
        for (std::uint32_t i = 0; i < kNodesPerBlock; ++i) {
            const NodeData data = makeStrip((10 + i) * size);
            blocks[b].nodes.push_back(recordOfStrip(data, i));
            blocks[b].nodes.back().payload = pack.append(encodePayload(data).value()).value();
        }
        if (!pack.finish(blocks[b], 1, 2)) std::abort();
    }
    SceneInfo info;
    info.name = "small";
    info.program = "test";
    info.bounds = {glm::dvec3(0.0), glm::dvec3(1000.0)};
    if (!writeScene(folder, info, blocks)) std::abort();
    return openScene(folder).value();
}

// Keeps what it is given, and stops the test when something is uploaded twice or released without being
// there.
class StoringDevice final : public NodeDevice {
  public:
    Result<void> upload(NodeId node, const DecodedNode& content) override {
        if (!stored_.emplace(node, content).second) std::abort();
        return {};
    }
    void release(NodeId node) override {
        if (stored_.erase(node) != 1) std::abort();
    }
    [[nodiscard]] const std::map<NodeId, DecodedNode>& stored() const { return stored_; }
    [[nodiscard]] std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const auto& [node, content] : stored_) sum += content.sizeBytes();
        return sum;
    }

  private:
    std::map<NodeId, DecodedNode> stored_;
};

// The main thread's side of the frame, on a scene.
struct Walk {
    const Scene& scene;
    Loader& loader;
    NodeDevice& device;
    Residency residency;
    LoadPlan plan;
    View view = makeView(Camera{}, glm::dvec3(0.0), 64, 64);
    SelectSettings select;
    LoadSettings load;
    double nowSeconds = 0.0;
    std::vector<std::string> faults;

    Walk(const Scene& s, Loader& l, NodeDevice& d) : scene(s), loader(l), device(d) {
        residency.reset(scene.hierarchy);
    }
    void frame() {
        nowSeconds += 0.05;
        loader.advance(0.05);
        const UploadInput upload{scene.hierarchy, load, nowSeconds,
                                 [this](const Error& error) { faults.push_back(error.oneLine()); }};
        takeFinishedLoads(upload, loader, device, residency);
        planLoads({scene.hierarchy, view, select, load, {}, {}, nowSeconds}, residency, plan);
        for (const NodeId node : plan.evicted) device.release(node);
        loader.publish(plan.wishes, load);
    }
    // Returns whether nothing is left to be loaded before `seconds` of real time have gone by.
    bool untilLoaded(double seconds = 60.0) {
        const SteadyClock::time_point start = SteadyClock::now();
        do {
            frame();
            if (plan.everythingLoaded) return true;
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        } while (millisecondsSince(start) < seconds * 1000.0);
        return false;
    }
};

}  // namespace fb::test
