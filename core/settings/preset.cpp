#include "base/program_folder.h"
#include "settings/preset.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cstdlib>

#include "base/file_io.h"
#include "settings/knob_table.h"

namespace fb {
namespace {

constexpr std::uint64_t kPresetCapBytes = 1 << 20;

std::string placeOf(const toml::node& node) {
    return "line " + std::to_string(node.source().begin.line);
}

Result<void> admitNode(Settings& settings, const std::string& path, const toml::node& node,
                       std::string_view name) {
    const std::string source = std::string(name) + ": " + placeOf(node);
    const Knob* knob = findKnob(path);
    if (!knob) return setFromText(settings, path, {}, source);
    if (knob->type == KnobType::boolean && node.is_boolean()) {
        return admit(settings, *knob, node.as_boolean()->get() ? 1.0 : 0.0, source);
    }
    if (knob->type == KnobType::choice && node.is_string()) {
        return setFromText(settings, path, node.as_string()->get(), source);
    }
    const bool number = node.is_number() && knob->type != KnobType::boolean && knob->type != KnobType::choice;
    if (number) return admit(settings, *knob, *node.value<double>(), source);
    return failure(source, path, "has the wrong type",
                   "it should be like " + valueText(*knob, knob->initial));
}

// Values are set without the rules between knobs, which only the whole preset must keep: the order of lines
// does not matter then.
Result<void> admitGroup(Settings& settings, const std::string& group, const toml::table& values,
                        std::string_view name) {
    for (const auto& [key, node] : values) {
        const std::string path = group + "." + std::string(key.str());
        Settings alone;  // the defaults keep the rules, except for the two ends of one
        alone.select.hystSwitch = 1.0;
        alone.select.hystLimit = 1.0e7;
        if (Result<void> fits = admitNode(alone, path, node, name); !fits) return fits;
        const Knob* knob = findKnob(path);
        knob->set(settings, knob->get(alone));
    }
    return {};
}

// checkTogether with the line of a knob that takes part in the broken rule; one of them is in the file, for
// the defaults keep the rules.
Result<void> checkRules(const Settings& settings, const toml::table& root, std::string_view name) {
    const toml::node_view<const toml::node> select = root["select"];
    const toml::node* culprit = select["hyst_switch"].node();
    if (!culprit) culprit = select["hyst_limit"].node();
    return checkTogether(settings,
                         culprit ? std::string(name) + ": " + placeOf(*culprit) : std::string(name));
}

// TOML allows no control characters in a text of one line or a comment.
std::string onOneLine(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

}  // namespace

Result<Preset> parsePreset(std::string_view text, std::string_view name) {
    toml::table root;
    try {
        root = toml::parse(text, name);
    } catch (const toml::parse_error& problem) {
        return failure(std::string(name), "line " + std::to_string(problem.source().begin.line),
                       std::string(problem.description()), "a preset is a TOML file");
    }
    Preset preset;
    preset.name = std::filesystem::path(std::string(name)).stem().string();
    for (const auto& [key, node] : root) {
        if (key.str() == "about") {
            if (!node.is_string()) {
                return failure(std::string(name) + ": " + placeOf(node), "about", "has the wrong type",
                               "it should be a text in quotes");
            }
            preset.about = node.as_string()->get();
        } else if (node.is_table() && std::ranges::find(knobGroups(), key.str()) != knobGroups().end()) {
            Result<void> group = admitGroup(preset.settings, std::string(key.str()), *node.as_table(), name);
            if (!group) return passOn(group);
        } else {
            return failure(std::string(name), placeOf(node),
                           "\"" + std::string(key.str()) + "\" is not part of a preset",
                           "knobs stand in the table of their group, as in [select]");
        }
    }
    if (Result<void> rules = checkRules(preset.settings, root, name); !rules) return passOn(rules);
    return preset;
}

std::string presetToml(const Preset& preset) {
    const Settings defaults;
    std::string text = "about = \"";
    for (char c : onOneLine(preset.about)) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    text += "\"\n";
    for (const std::string& note : preset.notes) text += "# " + onOneLine(note) + "\n";
    for (std::string_view group : knobGroups()) {
        bool headed = false;
        for (const Knob& knob : knobs()) {
            const double value = knob.get(preset.settings);
            if (knob.group != group || value == knob.get(defaults)) continue;
            if (!headed) text += "\n[" + std::string(group) + "]\n";
            headed = true;
            text += std::string(knob.key) + " = " + valueText(knob, value);
            if (!knob.unit.empty() && knob.unit != "1") text += "  # " + std::string(knob.unit);
            text += "\n";
        }
    }
    return text;
}

Result<void> savePreset(const Preset& preset, const std::filesystem::path& path) {
    const std::string text = presetToml(preset);
    if (Result<Preset> back = parsePreset(text, path.string()); !back)
        return passOn(back);  // `about` is no UTF-8
    if (path.has_parent_path()) {
        if (Result<void> made = makeFolder(path.parent_path()); !made) return made;
    }
    return writeFileAtomically(path, text);
}

std::filesystem::path userPresetFolder() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) {
        return std::filesystem::path(config) / "frontbench" / "presets";
    }
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home && *home ? home : ".") / ".config" / "frontbench" / "presets";
}

std::vector<PresetFile> listPresets() {
    std::vector<PresetFile> files;
    // What ships comes first: `default` is the same for everybody.
    const std::pair<std::filesystem::path, bool> folders[] = {{programFolder() / "presets", true},
                                                              {userPresetFolder(), false}};
    for (const auto& [folder, shipped] : folders) {
        std::error_code missing;
        for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
            if (entry.path().extension() != ".toml") continue;
            const std::string name = entry.path().stem().string();
            const bool hidden =
                std::ranges::any_of(files, [&](const PresetFile& f) { return f.name == name; });
            if (!hidden) files.push_back({name, entry.path(), shipped});
        }
    }
    std::ranges::sort(files, {}, &PresetFile::name);
    return files;
}

Result<Preset> loadPreset(std::string_view nameOrPath) {
    std::filesystem::path path{std::string(nameOrPath)};
    if (path.extension() != ".toml" && !path.has_parent_path()) {
        std::string known;
        for (const PresetFile& file : listPresets()) {
            if (file.name == nameOrPath) path = file.path;
            known += (known.empty() ? "" : ", ") + file.name;
        }
        if (path.extension() != ".toml") {
            return failure(std::string(nameOrPath), {}, "there is no preset of this name",
                           "there are: " + known);
        }
    }
    Result<std::vector<std::uint8_t>> bytes = readFile(path, kPresetCapBytes);
    if (!bytes) return passOn(bytes);
    return parsePreset({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

std::vector<std::string> presetDifferences(const Settings& from, const Settings& to) {
    std::vector<std::string> lines;
    for (const Knob& knob : knobs()) {
        const double a = knob.get(from);
        const double b = knob.get(to);
        if (a != b) lines.push_back(knob.path + ": " + valueLabel(knob, a) + " -> " + valueLabel(knob, b));
    }
    return lines;
}

}  // namespace fb
