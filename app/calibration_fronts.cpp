#include "app/calibration_fronts.h"

#include <algorithm>
#include <limits>

#include "load/decode_payload.h"

namespace fb {
namespace {

// A front that takes longer is the finest: the next level has some four times its triangles.
constexpr double kLongEnoughMs = 30.0;

// From the street, on the way and from above; the same for each run.
std::vector<View> chooseViews(const Workbench& w, glm::ivec2 size) {
    std::vector<View> views;
    const std::pair<const char*, double> places[] = {{"still", 0.0}, {"walk", 0.5}, {"fly", 0.25}, {"fly", 0.75}};
    for (const auto& [name, part] : places) {
        const Result<CameraPath> path = loadPath(name, w.scene->info);
        if (path) views.push_back(viewAlong(w, *path, part * path->durationSeconds(), size));
    }
    return views;
}

// The nodes in view of one level, and leaves above it.
std::vector<NodeId> frontOfLevel(const Hierarchy& h, const View& view, std::uint32_t level) {
    std::vector<NodeId> front;
    for (NodeId n = 0; n < h.size(); ++n) {
        const bool drawn = h.level[n] == level || (h.level[n] < level && h.isLeaf(n));
        if (drawn && meetsView(view, h.bounds[n])) front.push_back(n);
    }
    return front;
}

// Parents of a front's nodes are in the fronts of the levels above: boxes contain those of the children.
Result<void> loadNodes(Workbench& w, const std::vector<NodeId>& wanted, const Progress& progress) {
    ScenePacks packs(*w.scene);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!progress("loading", static_cast<double>(i) / static_cast<double>(wanted.size()))) {
            return failure({}, {}, "stopped");
        }
        Result<std::unique_ptr<DecodedNode>> content = readAndDecode(*w.scene, packs, wanted[i]);
        if (!content) return passOn(content);
        if (Result<void> sent = w.renderer->upload(wanted[i], **content); !sent) return sent;
        w.residency.setResident(w.scene->hierarchy, wanted[i]);
    }
    return {};
}

std::vector<NodeId> missingNodes(const Workbench& w, const std::vector<TimedFronts::Front>& fronts) {
    std::vector<NodeId> missing;
    for (const TimedFronts::Front& front : fronts) {
        for (NodeId node : front.nodes) {
            if (w.residency.loaded[node] == 0) missing.push_back(node);
        }
    }
    std::ranges::sort(missing);
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    return missing;
}

std::uint64_t bytesOf(const Hierarchy& hierarchy, const std::vector<NodeId>& nodes) {
    std::uint64_t bytes = 0;
    for (NodeId node : nodes) bytes += hierarchy.residentBytes[node];
    return bytes;
}

// Of the fronts from `first` on, each drawn twice: the first picture of a front pays for what is drawn first.
Result<double> longestMs(Workbench& w, const TimedFronts& timed, std::size_t first) {
    double longest = 0.0;
    for (std::size_t i = first; i < timed.fronts.size(); ++i) {
        const TimedFronts::Front& front = timed.fronts[i];
        double quicker = std::numeric_limits<double>::infinity();
        for (int pass = 0; pass < 2; ++pass) {
            const Result<double> ms = timeFront(w, timed.views[front.view], front.nodes, false);
            if (!ms) return ms;
            quicker = std::min(quicker, *ms);
        }
        longest = std::max(longest, quicker);
    }
    return longest;
}

}  // namespace

Result<CalibrationFronts> makeCalibrationFronts(Workbench& w, glm::ivec2 size, const Progress& progress) {
    const Hierarchy& hierarchy = w.scene->hierarchy;
    CalibrationFronts made;
    TimedFronts& timed = made.timed;
    timed.views = chooseViews(w, size);
    if (timed.views.empty()) return failure(w.scene->folder.string(), {}, "no view of the scene can be made");
    timed.fronts.push_back({0, {}});
    for (std::uint32_t level = 0; level <= hierarchy.maxLevel(); ++level) {
        std::vector<TimedFronts::Front> fronts;
        for (std::uint32_t v = 0; v < timed.views.size(); ++v) {
            std::vector<NodeId> front = frontOfLevel(hierarchy, timed.views[v], level);
            if (!front.empty()) fronts.push_back({v, std::move(front)});
        }
        const std::vector<NodeId> missing = missingNodes(w, fronts);
        if (w.residency.totalBytes() + bytesOf(hierarchy, missing) > budgetBytes(w.settings.load)) break;
        if (Result<void> loaded = loadNodes(w, missing, progress); !loaded) return passOn(loaded);
        const std::size_t first = timed.fronts.size();
        timed.fronts.insert(timed.fronts.end(), fronts.begin(), fronts.end());
        made.levels = level + 1;
        Result<double> longest = longestMs(w, timed, first);
        if (!longest) return passOn(longest);
        if (level > 0 && *longest > kLongEnoughMs) break;  // from two levels on there is a slope
    }
    made.repeats = made.levels < 2;
    const std::size_t count = timed.fronts.size();
    for (std::size_t i = 1; made.repeats && i < count; ++i) {
        const TimedFronts::Front once = timed.fronts[i];
        timed.fronts.push_back({once.view, repeated(hierarchy, once.nodes)});
    }
    return made;
}

}  // namespace fb
