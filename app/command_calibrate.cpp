// `frontbench calibrate`: measures the constants of the cost model and saves them as a preset.
#include <unistd.h>

#include <array>
#include <cstdio>

#include "app/calibration.h"
#include "app/commands.h"
#include "app/guarded_child.h"
#include "app/headless.h"
#include "app/progress_display.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {
namespace {

using Row = std::array<std::string, 5>;

// Said before minutes of measuring, not after.
Result<std::filesystem::path> chooseFile(const CalibrateCommand& command) {
    if (command.out.empty()) return userPresetFolder() / "calibrated.toml";
    if (command.out.extension() != ".toml" || !command.out.has_stem()) {
        return usageFailure("--out " + command.out.string(), "is not the name of a preset's file", "write NAME.toml");
    }
    std::error_code unreadable;
    if (std::filesystem::is_directory(command.out, unreadable)) {
        return failure(command.out.string(), {}, "is a folder", "name a file in it: " + (command.out / "NAME.toml").string());
    }
    const std::filesystem::path folder = command.out.has_parent_path() ? command.out.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, unreadable)) {
        return failure(command.out.string(), folder.string(), "there is no such folder", "make it first");
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        return failure(command.out.string(), folder.string(), "the folder cannot be written to", "choose another one");
    }
    return command.out;
}

std::string thesisValue(const std::string& knob) {
    if (knob == "select.c_textured") return "0.127";
    if (knob == "load.c_memory") return "935";
    return "-";  // measured there too, and not printed
}

std::string valueOf(const CalibratedConstant& constant, double value) {
    if (value == 0.0 && constant.knob.starts_with("control.")) return "at start";
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string nameOf(const CalibratedConstant& constant) {
    const Knob& knob = *findKnob(constant.knob);
    return constant.knob + (knob.unit == "1" ? "" : " (" + std::string(knob.unit) + ")");
}

void printTable(const Calibration& calibration, const std::string& from) {
    std::vector<Row> rows = {{"constant", "measured", "uncertainty", from, "thesis"}};
    for (const CalibratedConstant& c : calibration.constants) {
        rows.push_back({nameOf(c), c.kept.empty() ? valueOf(c, c.value) : "kept", c.kept.empty() ? c.spread : c.kept,
                        valueOf(c, c.before), thesisValue(c.knob)});
    }
    Row padded;
    for (const Row& row : rows) {
        for (std::size_t i = 0; i + 1 < row.size(); ++i) {
            std::size_t width = 0;
            for (const Row& other : rows) width = std::max(width, other[i].size());
            padded[i] = row[i] + std::string(width - row[i].size(), ' ');
        }
        std::printf("%s  %s  %s  %s  %s\n", padded[0].c_str(), padded[1].c_str(), padded[2].c_str(), padded[3].c_str(),
                    row[4].c_str());
    }
}

Preset makePreset(const CalibrateCommand& command, const Workbench& w, const Calibration& calibration,
                  const std::filesystem::path& file) {
    const std::string device = w.clock == ClockKind::model ? "the simulated device" : w.renderer->deviceName();
    Preset preset{file.stem().string(), "Calibrated with " + w.scene->info.name + " on " + device + "; other knobs as in " + command.headless.preset,
                  w.settings, calibration.facts};
    for (const CalibratedConstant& c : calibration.constants) {
        preset.notes.push_back(c.knob + ": " + (c.kept.empty() ? c.spread : "kept, for " + c.kept));
    }
    return preset;
}

}  // namespace

Result<void> runCalibrate(const CalibrateCommand& command) {
    std::unique_ptr<OffscreenContext> context;
    Workbench w;
    Result<glm::ivec2> size = takeOptions(w, command.headless);
    if (!size) return passOn(size);
    Result<std::filesystem::path> file = chooseFile(command);
    if (!file) return passOn(file);
    if (Result<void> opened = openHeadless(w, context, command.headless.scene, false); !opened) return opened;

    watchForStop();
    Result<Calibration> calibration = measureConstants(w, *size, showProgress(ProgressStyle::automatic));
    if (w.clock == ClockKind::real) endProgress(ProgressStyle::automatic);
    if (!calibration) return passOn(calibration);
    if (stopWanted()) return failure({}, {}, "stopped");
    if (Result<void> saved = savePreset(makePreset(command, w, *calibration, *file), *file); !saved) return saved;
    if (!calibration->warning.empty()) std::fprintf(stderr, "note: %s\n", calibration->warning.c_str());
    printTable(*calibration, std::filesystem::path(command.headless.preset).stem().string());
    std::printf("saved %s\n", file->string().c_str());
    return {};
}

}  // namespace fb
