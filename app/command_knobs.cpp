// `frontbench knobs` and `frontbench presets`: the knob table and presets as text.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {
namespace {

std::string typeName(KnobType type) {
    switch (type) {
        case KnobType::real: return "real";
        case KnobType::integer: return "integer";
        case KnobType::boolean: return "boolean";
        case KnobType::choice: return "choice";
    }
    return {};
}

nlohmann::ordered_json knobJson(const Knob& knob) {
    nlohmann::ordered_json json = {{"path", knob.path},
                                   {"symbol", knob.symbol},
                                   {"type", typeName(knob.type)},
                                   {"unit", knob.unit},
                                   {"default", valueLabel(knob, knob.initial)},
                                   {"reruns", knob.reruns == KnobReruns::build ? "build" : "frame"},
                                   {"equation", knob.equation},
                                   {"help", knob.help}};
    if (knob.type == KnobType::choice) {
        json["choices"] = knob.choices;
    } else if (knob.type != KnobType::boolean) {
        json["range"] = {knob.low, knob.high};
    }
    return json;
}

std::string rangeLabel(const Knob& knob) {
    if (knob.type == KnobType::boolean) return "true, false";
    if (knob.type != KnobType::choice) return valueLabel(knob, knob.low) + " .. " + valueLabel(knob, knob.high);
    std::string text;
    for (std::string_view choice : knob.choices) text += (text.empty() ? "" : ", ") + std::string(choice);
    return text;
}

}  // namespace

Result<void> runKnobs(bool json) {
    if (json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const Knob& knob : knobs()) all.push_back(knobJson(knob));
        std::printf("%s\n", all.dump(2).c_str());
        return {};
    }
    std::string_view group;
    for (const Knob& knob : knobs()) {
        if (knob.group != group) std::printf("%s[%s]\n", group.empty() ? "" : "\n", std::string(knob.group).c_str());
        group = knob.group;
        std::printf("%-26s %s%s%s  (%s)\n", knob.path.c_str(), valueLabel(knob, knob.initial).c_str(),
                    knob.unit.empty() || knob.unit == "1" ? "" : " ",
                    knob.unit == "1" ? "" : std::string(knob.unit).c_str(), rangeLabel(knob).c_str());
        std::printf("    %s%s%s\n", knob.symbol.empty() ? "" : std::string(knob.symbol).c_str(),
                    knob.symbol.empty() ? "" : ": ", std::string(knob.help).c_str());
        if (!knob.equation.empty()) std::printf("    %s\n", std::string(knob.equation).c_str());
    }
    return {};
}

Result<void> runPresetsList() {
    for (const PresetFile& file : listPresets()) {
        const Result<Preset> preset = loadPreset(file.path.string());
        std::printf("%-16s %s  %s\n", file.name.c_str(), file.shipped ? "shipped" : "yours  ",
                    preset ? preset->about.c_str() : preset.error().oneLine().c_str());
    }
    return {};
}

Result<void> runPresetsShow(const std::string& name) {
    Result<Preset> preset = loadPreset(name);
    if (!preset) return passOn(preset);
    std::printf("%s", presetToml(*preset).c_str());
    return {};
}

Result<void> runPresetsDiff(const std::string& from, const std::string& to) {
    Result<Preset> a = loadPreset(from);
    if (!a) return passOn(a);
    Result<Preset> b = loadPreset(to);
    if (!b) return passOn(b);
    for (const std::string& line : presetDifferences(a->settings, b->settings)) std::printf("%s\n", line.c_str());
    return {};
}

}  // namespace fb
