// A walk whose times come from the simulated device and go back through the feedback: the frame without
// pictures.
#pragma once

#include <optional>

#include "control/control.h"
#include "control/model_device.h"
#include "worlds/tiny_walk.h"

namespace fb {

struct ClosedLoop {
    TinyWalk walk;
    Settings settings;
    ControlState control;
    FeatureRing ring;
    TimeModel time;
    ModelCounts counts;
    double actualMs = 0.0;
    std::uint64_t toggles = 0;

    // v_time starts right for textured triangles; their neighbours' node overhead is for the feedback to find
    // out.
    ClosedLoop(Hierarchy world, const Settings& all)
        : walk(std::move(world), all.select),
          settings(all),
          control(startControl(all.control,
                               {all.model.texturedUs / all.select.cTextured / 1000.0, all.model.overheadMs, 0.0},
                               all.select.cTextured)) {
        walk.effects[Effect::shareFeedback] = true;
    }

    // `measuredMs` stands in for the device's time: a stall, or a device of other speed.
    void step(std::optional<double> measuredMs = std::nullopt) {
        passTime(control, settings.control, walk.dtSeconds, walk.state.patience);
        time = timeModel(control, settings.control, walk.settings.cTextured, 0.0, nullptr);
        walk.shareMs = shareMs(control, settings.control);
        walk.targetMs = settings.control.targetMs;
        ++walk.frame;
        SelectInput input = walk.input();
        input.time = time;
        selectFront(input, walk.state, walk.selection);
        const Selection& s = walk.selection;
        ring.push(featuresOf(input, s, 0.0));
        const FrameWork work = modelWork(settings.model, walk.hierarchy, s.front, 0.0, 0, counts);
        actualMs = measuredMs ? *measuredMs : modelFrameMs(settings.model, work, walk.frame, counts);
        walk.measured = {s.triangles, actualMs};
        feedBack(control, settings.control, *ring.find(walk.frame), actualMs);
        toggles += s.counters.togglesUp + s.counters.togglesDown;
    }
    void run(int frames) {
        for (int i = 0; i < frames; ++i) step();
    }
};

// Two rows of eight houses along -z, each a block of three levels with four children a node and 900 triangles
// each: 336 nodes, none of which is like another in size or distance.
inline Hierarchy streetWorld() {
    std::vector<TinyNode> houses;
    for (int i = 0; i < 16; ++i) {
        const float x = i % 2 == 0 ? -9.0f : 5.0f;
        const float z = -6.0f - 12.0f * static_cast<float>(i / 2);
        const float width = 4.0f, height = 6.0f + static_cast<float>(i % 5), depth = 10.0f;
        const auto part = [&](int row, int column, float rows) {
            const float d = depth / rows, h = height / rows;
            const float low = h * static_cast<float>(row), back = z - d * static_cast<float>(column + 1);
            return boxOf({x, low, back}, {x + width, low + h, back + d});
        };
        const auto benefit = [](float area) { return std::sqrt(900.0f * area); };
        TinyNode house{.cost = 450, .benefit = benefit(depth * height), .box = part(0, 0, 1)};
        for (int a = 0; a < 4; ++a) {
            const Box3f box = part(a / 2, a % 2, 2);
            TinyNode wall{.cost = 450, .benefit = benefit(depth * height / 4), .box = box};
            for (int b = 0; b < 4; ++b) {
                wall.children.push_back({.cost = 450,
                                         .benefit = benefit(depth * height / 16),
                                         .box = part(2 * (a / 2) + b / 2, 2 * (a % 2) + b % 2, 4)});
            }
            house.children.push_back(wall);
        }
        houses.push_back(house);
    }
    return makeWorld(houses);
}

// Five places to stand in the street, 90 degrees of view.
inline View streetView(int which) {
    const glm::dvec3 eyes[] = {{0, 2, 0}, {2, 2, -20}, {-3, 6, -40}, {0, 30, 10}, {1, 2, -60}};
    const glm::dvec3 targets[] = {{0, 2, -1}, {-5, 2, -30}, {6, 3, -60}, {0, 0, -50}, {0, 3, 0}};
    Camera camera = lookAt(eyes[which], targets[which], {0, 1, 0});
    camera.fovyRadians = tinyCamera().fovyRadians;
    return makeView(camera, glm::dvec3(0.0), 160, 90);
}

}  // namespace fb
