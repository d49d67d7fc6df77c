// Presets: TOML files with the knobs that differ from the defaults, one table per group, plus `about` (what it is
// for) and comments. Reading admits each value through the gate of knob_table.h and reports file and line of what it refuses.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "settings/settings.h"

namespace fb {

struct Preset {
    std::string name;   // file name without ".toml"
    std::string about;  // one line: what it is for
    Settings settings;
    std::vector<std::string> notes{};  // comment lines written below `about`; not read back
};

struct PresetFile {
    std::string name;
    std::filesystem::path path;
    bool shipped;  // false: the user's own
};

[[nodiscard]] Result<Preset> parsePreset(std::string_view toml, std::string_view name);
[[nodiscard]] std::string presetToml(const Preset& preset);
[[nodiscard]] Result<void> savePreset(const Preset& preset, const std::filesystem::path& path);

// The user's own: $XDG_CONFIG_HOME/frontbench/presets. Presets that ship are never hidden by one of the same name there.
[[nodiscard]] std::filesystem::path userPresetFolder();
[[nodiscard]] std::vector<PresetFile> listPresets();
// `nameOrPath`: a name from listPresets() or a path to a .toml file.
[[nodiscard]] Result<Preset> loadPreset(std::string_view nameOrPath);

// "select.c_vis: 1.275 -> 2" for each knob that differs.
[[nodiscard]] std::vector<std::string> presetDifferences(const Settings& from, const Settings& to);

}  // namespace fb
