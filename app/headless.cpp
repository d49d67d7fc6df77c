#include "app/headless.h"

#include "app/commands.h"
#include "base/program_folder.h"

namespace fb {

Result<ClockKind> parseClock(const std::string& text) {
    if (text == "real") return ClockKind::real;
    if (text == "model") return ClockKind::model;
    return usageFailure("--clock " + text, "is not a clock", "real or model");
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
