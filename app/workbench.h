// The one owner of everything that a walk needs: scene, settings, what is in memory, the selection's and the feedback's
// state, records. Shared by the window and the headless replay. Main thread only; the loader's thread is behind Loader.
// Members stand in the order in which they may be destroyed from the bottom: the loader stops before the scene goes,
// the renderer goes before the caller's GL context.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/control.h"
#include "control/model_device.h"
#include "draw/renderer.h"
#include "load/load_timeline.h"
#include "load/loader.h"
#include "measure/history.h"
#include "select/select.h"
#include "settings/settings.h"

namespace fb {

enum class ClockKind { real, model };

// Settings whose change asks for more than to be read: as they were in the frame before.
struct AppliedSettings {
    double cTextured = 0.0, hystStart = 0.0, vTimeStartMs = 0.0, overheadMs = 0.0, fillMsPerMegapixel = 0.0;
};

struct Workbench {
    Settings settings;
    ClockKind clock = ClockKind::real;
    std::function<void(const Error&)> onFault;          // hears each fault of loading once; may be empty
    std::function<void(const FrameRecord&)> onRecord;   // hears each finished record; may be empty

    std::unique_ptr<Scene> scene;  // at one place, because the loader refers to it
    SceneFacts sceneFacts;
    std::unique_ptr<Renderer> renderer;  // null: nothing is drawn (model clock without pictures)
    NullDevice nullDevice;
    Residency residency;
    LoadPlan plan;
    std::vector<std::uint8_t> inFront;  // one a node: in the front drawn last
    std::unique_ptr<Loader> loader;
    LoadTimeline timeline;
    double walkBeganSeconds = 0.0;      // on the loader's clock

    SelectState selectState;
    Selection selection;
    ActiveEffects effects;
    ControlState control;
    std::optional<MeasuredConstants> knownConstants;  // then opening a scene measures nothing
    View view;                // of this frame
    MeasuredFront measured;   // the newest whose time is known
    std::vector<NodeId> seenFront;  // scratch
    ModelCounts modelCounts;
    FeatureRing features;

    std::uint64_t frame = 0;      // counts up by one a frame; the first is 1
    double nowSeconds = 0.0;      // sum of the frames' dt
    std::uint64_t frontHash = 0;  // chained over all frames
    std::array<FrameRecord, 16> pending;  // by frame number: waiting for their time
    History history;
    std::array<std::uint64_t, kEffectCount> effectFrames{};  // frames in which each effect was active
    EffectWork effectWork;                                   // over all frames
    double lastUiMs = 0.0;
    LoaderCounters loaderBefore;     // when the walk began
    AppliedSettings applied;

    [[nodiscard]] NodeDevice& device() { return renderer ? static_cast<NodeDevice&>(*renderer) : nullDevice; }
    ~Workbench();
    Workbench() = default;
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;
};

// Opens a scene folder in the workbench in place of what was open: loads all roots, starts the loader, calibrates. With
// an error the workbench is left without a scene. The renderer, if there is to be one, must be there already.
[[nodiscard]] Result<void> openScene(Workbench& workbench, const std::filesystem::path& folder);
void closeScene(Workbench& workbench);

// Measures the fixed overhead and the start value of v_time by drawing (real clock) or from the simulated device.
void calibrate(Workbench& workbench);
// The same by the simulated device alone.
void calibrateByModel(Workbench& workbench);

// Before a frame: what follows from settings that were changed since the one before. Another c_textured is another unit of
// cost, in which v_time is converted; another h_0 starts all counters again, another v_time_start or overhead the feedback.
void followSettings(Workbench& workbench);

// The camera's near plane: the knob's, or a small part of a small scene.
[[nodiscard]] double nearMetres(const Workbench& workbench);

// Forgets the walk so far (counters, history, front hash) and keeps what is loaded.
void restartWalk(Workbench& workbench);

// Lets the camera rest at its place until nothing more is loaded, or for `limitSeconds` of frame time.
struct FrameInput;
void settle(Workbench& workbench, const FrameInput& input, double limitSeconds);

}  // namespace fb
