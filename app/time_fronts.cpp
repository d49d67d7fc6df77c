#include "app/time_fronts.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/guarded_child.h"
#include "base/clock.h"
#include "select/coverage.h"

namespace fb {
namespace {

constexpr std::uint64_t kMostDraws = 1000;         // of nodes, in one picture
constexpr std::uint64_t kTrianglesToTime = 60000;  // enough to rise above the overhead, about 5 ms on two cores
constexpr int kLongestWaitMs = 500;                   // for the time of one picture

FrontTimes countFront(const Hierarchy& hierarchy, const TimedFronts::Front& front, const View& view) {
    FrontTimes times;
    times.view = front.view;
    times.megapixels = megapixelsOfRoots(hierarchy, view);
    for (NodeId node : front.nodes) {
        times.texturedTriangles += hierarchy.texturedTriangles[node];
        times.untexturedTriangles += hierarchy.untexturedTriangles[node];
    }
    return times;
}

// The second of two pictures: as in a walk, where the one before was much the same. The first after another front is
// up to half as slow again, for caches.
Result<double> timeSteadily(Workbench& w, const View& view, const std::vector<NodeId>& nodes, bool plain) {
    if (Result<double> first = timeFront(w, view, nodes, plain); !first) return first;
    return timeFront(w, view, nodes, plain);
}

// Both ways in turn, the first one another in each round: what drifts falls on both alike.
Result<void> timeBothWays(Workbench& w, const View& view, const std::vector<NodeId>& nodes, bool plainFirst,
                          FrontTimes& times) {
    for (const bool plain : {plainFirst, !plainFirst}) {
        Result<double> ms = timeSteadily(w, view, nodes, plain);
        if (!ms) return passOn(ms);
        (plain ? times.plainMs : times.ms).push_back(*ms);
    }
    return {};
}

}  // namespace

View viewAlong(const Workbench& w, const CameraPath& path, double seconds, glm::ivec2 size) {
    Camera camera = path.at(seconds);
    camera.fovyRadians = glm::radians(w.settings.draw.fovyDegrees);
    camera.nearMetres = nearMetres(w);
    return makeView(camera, glm::dvec3(0.0), size.x, size.y);
}

std::vector<NodeId> repeated(const Hierarchy& hierarchy, const std::vector<NodeId>& nodes) {
    std::uint64_t triangles = 0;
    for (NodeId node : nodes) triangles += hierarchy.triangles(node);
    const std::uint64_t more = 1 + std::min(kTrianglesToTime / std::max<std::uint64_t>(triangles, 1),
                                            kMostDraws / std::max<std::uint64_t>(nodes.size(), 1));
    std::vector<NodeId> often;
    for (std::uint64_t i = 0; i <= more; ++i) often.insert(often.end(), nodes.begin(), nodes.end());
    return often;
}

void countCosts(const Workbench& w, const TimedFronts& fronts, std::vector<FrontTimes>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i].cost = 0.0;
        for (NodeId node : fronts.fronts[i].nodes) {
            times[i].cost += nodeCost(w.scene->hierarchy, node, w.settings.select.cTextured);
        }
    }
}

Result<double> timeFront(Workbench& w, const View& view, std::span<const NodeId> front, bool plain) {
    if (stopWanted()) return failure({}, {}, "stopped");
    ActiveEffects effects = w.effects;
    if (plain) effects[Effect::texturing] = false;
    const DrawInput input{w.scene->hierarchy, front, view, w.settings.draw, effects, glm::vec3(w.scene->info.upVector())};
    w.renderer->draw(input, 0);
    if (!w.renderer->fault().empty()) return failure("drawing", {}, w.renderer->fault());
    DrawTime time;
    for (int waited = 0; waited < kLongestWaitMs; ++waited) {
        if (w.renderer->takeTime(time) && time.frame == 0) return time.milliseconds;  // others are of a walk before
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return failure("drawing", {}, "the device did not tell the time of a picture", "another program may keep it busy");
}

Result<std::vector<FrontTimes>> timeFronts(Workbench& w, const TimedFronts& fronts, const TimingPlan& plan,
                                           const Progress& progress) {
    std::vector<FrontTimes> times;
    for (const TimedFronts::Front& front : fronts.fronts) times.push_back(countFront(w.scene->hierarchy, front, fronts.views[front.view]));
    countCosts(w, fronts, times);
    SteadyClock::time_point start = SteadyClock::now();
    for (int round = -1; round < plan.mostRounds; ++round) {
        const double seconds = millisecondsSince(start) / 1000.0;
        if (round >= plan.leastRounds && seconds >= plan.enoughSeconds) break;
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(times.size());
            if (progress) static_cast<void>(progress("timing", (round + 1 + part) / (plan.mostRounds + 1)));
            const TimedFronts::Front& front = fronts.fronts[i];
            const View& view = fronts.views[front.view];
            if (plan.withoutTextures) {
                Result<void> both = timeBothWays(w, view, front.nodes, round % 2 != 0, times[i]);
                if (!both) return passOn(both);
            } else {
                Result<double> ms = timeSteadily(w, view, front.nodes, false);
                if (!ms) return passOn(ms);
                times[i].ms.push_back(*ms);
            }
        }
        if (round >= 0) continue;
        for (FrontTimes& front : times) {  // the first pictures pay for compiling and paging in
            front.ms.clear();
            front.plainMs.clear();
        }
        start = SteadyClock::now();
    }
    return times;
}

}  // namespace fb
