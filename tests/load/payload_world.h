// A scene whose payloads lie in memory: real payload bytes, read through a source that the test controls.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/hash.h"
#include "load/payload_source.h"
#include "tiny_world.h"

namespace fb::test {

// A strip of `triangles` triangles without texture.
inline NodeData makeStrip(std::uint32_t triangles) {
    NodeData data;
    for (std::uint32_t i = 0; i < triangles + 2; ++i) {
        NodeVertex vertex{i * 37 % 1000, i * i % 991, i % 2, {0, 0}, 0, 0, {1, 2, 3, 255}};
        encodeNormal(glm::vec3(0, 0, 1), vertex.normal);
        data.mesh.vertices.push_back(vertex);
    }
    for (std::uint32_t i = 0; i < triangles; ++i) {
        for (const std::uint32_t corner : {i, i + 1, i + 2}) data.mesh.indices.push_back(corner);
    }
    data.mesh.untexturedTriangles = triangles;
    return data;
}

struct PayloadWorld {
    Scene scene;
    std::vector<std::vector<std::uint8_t>> packs;

    // Node n has `triangles[n]` triangles; all payloads stand one after the other in pack 0.
    PayloadWorld(std::vector<NodeSpec> specs, const std::vector<std::uint32_t>& triangles) {
        scene.hierarchy = makeHierarchy(specs);
        packs.resize(1);
        for (NodeId n = 0; n < specs.size(); ++n) {
            const std::vector<std::uint8_t> bytes = encodePayload(makeStrip(triangles[n])).value();
            PayloadRef& ref = scene.hierarchy.payload[n];
            ref.offset = packs[0].size();
            ref.sizeBytes = static_cast<std::uint32_t>(bytes.size());
            ref.checksum = hashBytes(bytes.data(), bytes.size());
            packs[0].insert(packs[0].end(), bytes.begin(), bytes.end());
            scene.hierarchy.residentBytes[n] =
                static_cast<std::uint32_t>(residentBytes(triangles[n] + 2, triangles[n], 0, 0));
        }
    }
    [[nodiscard]] std::uint32_t payloadBytes(NodeId node) const {
        return scene.hierarchy.payload[node].sizeBytes;
    }
};

inline std::uint32_t trianglesOf(NodeId node) {
    return 1 + node * 7 % 90;
}
// One root with so many children.
inline PayloadWorld manyNodes(std::uint32_t children) {
    std::vector<NodeSpec> specs = {{kRoot, 1, 0}};
    std::vector<std::uint32_t> triangles = {1};
    for (NodeId n = 1; n <= children; ++n) {
        specs.push_back({0, 1, 0});
        triangles.push_back(trianglesOf(n));
    }
    return {specs, triangles};
}

// What the test and the loader thread share. Reads wait for permits while the gate is closed.
class Disk {
  public:
    struct Read {
        std::uint64_t offset, bytes;
    };

    void closeGate() {
        change([this] { open_ = false; });
    }
    void openGate() {
        change([this] { open_ = true; });
    }
    void allow(int reads) {
        change([&] { permits_ += reads; });
    }
    std::vector<Read> reads() {
        const std::lock_guard lock(mutex_);
        return reads_;
    }
    // The read with this number (from 0) fails; only that one.
    void failRead(std::size_t number) {
        change([&] { failing_ = number; });
    }

    Result<void> read(const std::vector<std::uint8_t>& pack, std::uint64_t offset,
                      std::span<std::uint8_t> into) {
        std::unique_lock lock(mutex_);
        const std::size_t number = reads_.size();
        reads_.push_back({offset, into.size()});
        changed_.notify_all();
        changed_.wait(lock, [this] { return open_ || permits_ > 0; });
        if (!open_) --permits_;
        if (number == failing_) return failure("disk", {}, "EIO");
        std::copy_n(pack.begin() + static_cast<std::ptrdiff_t>(offset), into.size(), into.begin());
        return {};
    }

  private:
    template <class Change>
    void change(Change what) {
        {
            const std::lock_guard lock(mutex_);
            what();
        }
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = true;
    int permits_ = 0;
    std::vector<Read> reads_;
    std::optional<std::size_t> failing_;
};

class DiskSource final : public PayloadSource {
  public:
    DiskSource(const PayloadWorld& world, Disk& disk) : world_(world), disk_(disk) {}
    Result<void> readAt(std::uint32_t pack, std::uint64_t offset, std::span<std::uint8_t> into) override {
        return disk_.read(world_.packs[pack], offset, into);
    }

  private:
    const PayloadWorld& world_;
    Disk& disk_;
};

inline std::unique_ptr<Loader> startLoader(const PayloadWorld& world, Disk& disk) {
    return startLoaderThread(world.scene, std::make_unique<DiskSource>(world, disk));
}

// Waits for the next finished load.
inline FinishedLoad takeNext(Loader& loader) {
    FinishedLoad finished;
    while (!loader.take(finished, ~std::uint64_t{0})) std::this_thread::yield();
    return finished;
}

// Returns once the loader has asked for `count` reads in all, whether or not they were let through. It calls
// the loader meanwhile, as frames do: what publish() could not deliver at once is delivered with the next
// call.
inline void waitForReads(Loader& loader, Disk& disk, std::size_t count) {
    FinishedLoad none;
    while (disk.reads().size() < count) {
        if (loader.take(none, 0)) std::abort();  // every load of these tests takes more than 0 bytes
        std::this_thread::yield();
    }
}

// With one decoder loads come in the order in which they were read.
inline LoadSettings chunksOf(std::uint64_t bytes) {
    LoadSettings settings;
    settings.decoders = 1;
    settings.chunkKiB = static_cast<double>(bytes) / 1024.0;
    return settings;
}

}  // namespace fb::test
