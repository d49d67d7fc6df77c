#include <limits>
#include <string>
#include <utility>

#include "base/clock.h"
#include "load/decode_payload.h"
#include "load/load_timeline.h"
#include "load/loader.h"

namespace fb {
namespace {

void giveBack(const UploadInput& input, Residency& residency, const FinishedLoad& finished, double now, Error error) {
    const NodeId node = finished.node;
    if (input.timeline) input.timeline->noteFailed(finished.stamps, node, now);
    residency.setFailed(input.hierarchy, node, input.nowSeconds);
    ++residency.counters.failed;
    ++residency.counters.faults[static_cast<std::size_t>(finished.fault)];
    if (!input.onFault) return;
    if (error.place.empty()) error.place = nodePlace(node);
    if (residency.state[node] == NodeState::failed) {
        error.hint = "given up after " + std::to_string(kLoadTries) + " tries; its parent stays drawn";
    } else if (error.hint.empty()) {
        error.hint = "it will be tried again; its parent stays drawn";
    }
    input.onFault(error);
}

}  // namespace

std::uint64_t takeFinishedLoads(const UploadInput& input, Loader& loader, NodeDevice& device,
                                Residency& residency) {
    const auto budget = static_cast<std::uint64_t>(input.settings.uploadMiBPerFrame * kBytesPerMiB);
    const DecodedNode nothing;
    std::uint64_t handled = 0, uploaded = 0;  // handled: failed uploads cost time as well
    std::uint64_t cap = std::numeric_limits<std::uint64_t>::max();
    FinishedLoad finished;
    const SteadyClock::time_point begun = SteadyClock::now();
    const auto hasTime = [&] { return handled == 0 || input.limitMs <= 0.0 || millisecondsSince(begun) < input.limitMs; };
    while (hasTime() && loader.take(finished, cap)) {
        const NodeId node = finished.node;
        if (residency.state[node] != NodeState::wanted) continue;  // withdrawn before the loader heard of it
        if (!finished.content) {
            giveBack(input, residency, finished, loader.nowSeconds(), finished.content.error());
            continue;
        }
        residency.state[node] = NodeState::ready;
        const std::uint64_t bytes = input.hierarchy.residentBytes[node];
        const DecodedNode* content = finished.content->get();
        Result<void> sent = device.upload(node, content != nullptr ? *content : nothing);
        handled += bytes;
        cap = handled < budget ? budget - handled : 0;
        if (!sent) {
            finished.fault = LoadFault::upload;
            giveBack(input, residency, finished, loader.nowSeconds(), std::move(sent.error()));
            continue;
        }
        residency.setResident(input.hierarchy, node);
        ++residency.counters.completed;
        if (input.timeline) input.timeline->noteUploaded(finished.stamps, node, loader.nowSeconds());
        uploaded += bytes;
    }
    const LoaderCounters counters = loader.counters();
    residency.counters.suspended = counters.suspended;
    residency.counters.bytes = counters.bytesRead;
    residency.counters.seeks = counters.seeks;
    return uploaded;
}

Result<void> loadRoots(const Scene& scene, NodeDevice& device, Residency& residency, bool readContent) {
    const Hierarchy& hierarchy = scene.hierarchy;
    ScenePacks packs(scene);
    for (NodeId root = 0; root < hierarchy.rootCount; ++root) {
        Result<std::unique_ptr<DecodedNode>> content = std::make_unique<DecodedNode>();
        if (readContent) content = readAndDecode(scene, packs, root);
        Result<void> sent;
        if (content) sent = device.upload(root, **content);
        if (content && sent) {
            residency.setResident(hierarchy, root);
            continue;
        }
        Error error = std::move(content ? sent.error() : content.error());
        if (error.place.find(nodePlace(root)) == std::string::npos) {
            error.place = nodePlace(root) + (error.place.empty() ? "" : ", " + error.place);
        }
        while (root-- > 0) {
            device.release(root);
            residency.setUnloaded(hierarchy, root);
        }
        return tl::make_unexpected(std::move(error));
    }
    return {};
}

}  // namespace fb
