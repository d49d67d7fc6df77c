// Policy `full` on a built scene against the source drawn directly: pictures from several places of a path. Needs a
// surfaceless OpenGL context of its own.
#pragma once

#include <memory>
#include <vector>

#include "app/frame.h"
#include "base/program_folder.h"
#include "draw/offscreen_context.h"
#include "draw/source_renderer.h"
#include "measure/camera_path.h"
#include "measure/image_error.h"
#include "settings/knob_table.h"

namespace fb::test {

struct ComparedView {
    ImageError error;
    std::uint64_t drawnTriangles = 0;
    Image full, source;
};

struct ComparisonTask {
    const BlockSource& source;
    std::filesystem::path scene;
    std::string path = "fly";
    int views = 4, width = 1280, height = 720;  // a replay's default size
};

inline Result<std::vector<ComparedView>> compareWithSource(const ComparisonTask& task) {
    auto context = OffscreenContext::create();
    if (!context) return passOn(context);
    Workbench w;
    w.clock = ClockKind::model;
    w.settings.select.policy = PolicyId::full;
    w.settings.load.budgetMiB = findKnob("load.budget")->high;
    auto renderer = Renderer::create(programFolder() / "shaders");
    if (!renderer) return passOn(renderer);
    w.renderer = std::move(*renderer);
    if (auto opened = openScene(w, task.scene); !opened) return passOn(opened);
    auto path = loadPath(task.path, w.scene->info);
    if (!path) return passOn(path);
    std::vector<SourceBlock> blocks;
    for (std::size_t i = 0; i < task.source.blockCount(); ++i) {
        auto block = task.source.load(i);
        if (!block) return passOn(block);
        blocks.push_back(std::move(*block));
    }
    std::vector<ComparedView> views;
    for (int v = 0; v < task.views; ++v) {
        FrameInput input;
        input.camera = path->at(path->durationSeconds() * (v + 0.5) / task.views);
        input.width = task.width;
        input.height = task.height;
        if (v == 0) settle(w, input, 1e4);
        runFrame(w, input);
        const View view = makeView(input.camera, glm::dvec3(0.0), task.width, task.height);
        auto source = drawSource(programFolder() / "shaders", blocks, view, w.effects,
                                 glm::vec3(w.scene->info.upVector()));
        if (!source) return passOn(source);
        ComparedView compared;
        compared.full = w.renderer->readPicture();
        compared.source = std::move(*source);
        compared.drawnTriangles = w.selection.triangles;
        auto error = compareImages(compared.full, compared.source);
        if (!error) return passOn(error);
        compared.error = *error;
        views.push_back(std::move(compared));
    }
    return views;
}

}  // namespace fb::test
