#include "app/headless.h"

#include "app/option_text.h"
#include "base/program_folder.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {
namespace {

Result<ClockKind> parseClock(const std::string& text) {
    if (text == "real") return ClockKind::real;
    if (text == "model") return ClockKind::model;
    return usageFailure("--clock " + text, "is not a clock", "real or model");
}

}  // namespace

Result<glm::ivec2> takeOptions(Workbench& w, const HeadlessOptions& options) {
    Result<Preset> preset = loadPreset(options.preset);
    if (!preset) return passOn(preset);
    w.settings = preset->settings;
    if (Result<void> taken = applySets(w.settings, options.sets); !taken) return passOn(taken);
    Result<ClockKind> clock = parseClock(options.clock);
    if (!clock) return passOn(clock);
    w.clock = *clock;
    return parseSize(options.size);
}

Result<void> openHeadless(Workbench& w, std::unique_ptr<OffscreenContext>& context, const std::filesystem::path& scene,
                          bool pictures) {
    std::filesystem::path folder = scene;
    if (folder.empty()) {
        Result<std::filesystem::path> city = builtInCity(ProgressStyle::automatic);
        if (!city) return passOn(city);
        folder = *city;
    }
    if (w.clock == ClockKind::real || pictures) {
        auto made = OffscreenContext::create();
        if (!made) return passOn(made);
        context = std::move(*made);
        auto renderer = Renderer::create(programFolder() / "shaders");
        if (!renderer) return passOn(renderer);
        w.renderer = std::move(*renderer);
    }
    return openScene(w, folder);
}

}  // namespace fb
