#include "settings/knob_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "base/hash.h"

namespace fb {
namespace {

constexpr std::array<std::string_view, 7> kGroups = {"build", "select", "control", "load", "draw", "model", "effects"};
constexpr KnobReruns build = KnobReruns::build;
constexpr KnobReruns frame = KnobReruns::frame;

// The macros below turn each row of a .def file into a Knob. FB_GROUP is the group's member in Settings.
#define FB_ACCESS(member, Type)                                                      \
    [](const Settings& s) { return static_cast<double>(s.FB_GROUP.member); },        \
        [](Settings& s, double value) { s.FB_GROUP.member = static_cast<Type>(value); }
#define FB_NAME_OF(group) #group
#define FB_NAME(group) FB_NAME_OF(group)
#define FB_ROW(key, symbol, unit, help, equation, type, reruns, initial, low, high, choices, ...)                  \
    table.push_back(Knob{std::string(FB_NAME(FB_GROUP)) + "." + key, FB_NAME(FB_GROUP), key, symbol, unit, help,  \
                         equation, type, reruns, static_cast<double>(initial), low, high, choices, __VA_ARGS__});
#define FB_REAL(member, key, symbol, initial, low, high, unit, reruns, help, equation)                    \
    FB_ROW(key, symbol, unit, help, equation, KnobType::real, reruns, initial, low, high, {}, FB_ACCESS(member, double))
#define FB_INT(member, key, symbol, initial, low, high, unit, reruns, help, equation)                              \
    FB_ROW(key, symbol, unit, help, equation, KnobType::integer, reruns, initial, low, high, {},                   \
           FB_ACCESS(member, std::int64_t))
#define FB_BOOL(member, key, symbol, initial, reruns, help, equation) \
    FB_ROW(key, symbol, "", help, equation, KnobType::boolean, reruns, initial, 0.0, 1.0, {}, FB_ACCESS(member, bool))
#define FB_CHOICE(member, key, symbol, Type, initial, reruns, help, equation, ...)                                 \
    {                                                                                                              \
        static constexpr std::string_view names[] = {__VA_ARGS__};                                                 \
        FB_ROW(key, symbol, "", help, equation, KnobType::choice, reruns, initial, 0.0,                            \
               static_cast<double>(std::size(names) - 1), names, FB_ACCESS(member, Type))                          \
    }

std::vector<Knob> makeTable() {
    std::vector<Knob> table;
#define FB_GROUP build
#include "settings/knobs/build.def"
#undef FB_GROUP
#define FB_GROUP select
#include "settings/knobs/select.def"
#undef FB_GROUP
#define FB_GROUP control
#include "settings/knobs/control.def"
#undef FB_GROUP
#define FB_GROUP load
#include "settings/knobs/load.def"
#undef FB_GROUP
#define FB_GROUP draw
#include "settings/knobs/draw.def"
#undef FB_GROUP
#define FB_GROUP model
#include "settings/knobs/model.def"
#undef FB_GROUP
#define FB_GROUP effects
#include "settings/knobs/effects.def"
#undef FB_GROUP
    return table;
}

const std::vector<Knob>& table() {
    static const std::vector<Knob> rows = makeTable();
    return rows;
}

std::string rangeText(const Knob& knob) {
    if (knob.type == KnobType::boolean) return "true or false";
    if (knob.type == KnobType::choice) {
        std::string text = "one of";
        for (std::string_view name : knob.choices) text += " " + std::string(name);
        return text;
    }
    return "between " + valueLabel(knob, knob.low) + " and " + valueLabel(knob, knob.high) +
           (knob.unit.empty() || knob.unit == "1" ? "" : " " + std::string(knob.unit));
}

std::optional<double> parseValue(const Knob& knob, std::string_view text) {
    if (knob.type == KnobType::boolean) {
        if (text == "true" || text == "1" || text == "on") return 1.0;
        if (text == "false" || text == "0" || text == "off") return 0.0;
        return std::nullopt;
    }
    if (knob.type == KnobType::choice) {
        for (std::size_t i = 0; i < knob.choices.size(); ++i) {
            if (knob.choices[i] == text) return static_cast<double>(i);
        }
        return std::nullopt;
    }
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::span<const Knob> knobs() { return table(); }

std::span<const std::string_view> knobGroups() { return kGroups; }

const Knob* findKnob(std::string_view path) {
    for (const Knob& knob : table()) {
        if (knob.path == path) return &knob;
    }
    return nullptr;
}

Result<void> checkTogether(const Settings& settings, std::string_view source) {
    if (settings.select.hystSwitch > settings.select.hystLimit) {
        return failure(std::string(source), "select.hyst_switch", "c_hystSwitch must not be above c_hystLimit",
                       "raise select.hyst_limit first");
    }
    return {};
}

Result<void> admit(Settings& settings, const Knob& knob, double value, std::string_view source) {
    const bool whole = knob.type == KnobType::real || value == std::floor(value);
    if (!std::isfinite(value) || value < knob.low || value > knob.high || !whole) {
        return failure(std::string(source), knob.path, valueLabel(knob, value) + " is not allowed",
                       "it must be " + rangeText(knob));
    }
    Settings changed = settings;
    knob.set(changed, value);
    if (Result<void> together = checkTogether(changed, source); !together) return together;
    settings = changed;
    return {};
}

Result<void> setFromText(Settings& settings, std::string_view path, std::string_view text, std::string_view source) {
    const Knob* knob = findKnob(path);
    if (!knob) {
        return failure(std::string(source), std::string(path), "there is no such knob",
                       "`frontbench knobs` lists them all");
    }
    const std::optional<double> value = parseValue(*knob, text);
    if (!value) {
        return failure(std::string(source), knob->path, "\"" + std::string(text) + "\" is not a value of it",
                       "it must be " + rangeText(*knob));
    }
    return admit(settings, *knob, *value, source);
}

std::string valueLabel(const Knob& knob, double value) {
    if (knob.type == KnobType::boolean) return value != 0.0 ? "true" : "false";
    if (knob.type == KnobType::choice) {
        const auto index = static_cast<std::size_t>(value);
        if (value >= 0.0 && index < knob.choices.size()) return std::string(knob.choices[index]);
    }
    std::array<char, 40> text{};
    char* const last = text.data() + text.size();
    // The shortest text of the real 1000000 is 1e+06, which is no integer to TOML and no count to people.
    const bool count = knob.type == KnobType::integer && value == std::floor(value) && std::abs(value) < 1e15;
    const auto end = count ? std::to_chars(text.data(), last, static_cast<std::int64_t>(value)).ptr
                           : std::to_chars(text.data(), last, value).ptr;
    return {text.data(), end};
}

std::string valueText(const Knob& knob, double value) {
    std::string text = valueLabel(knob, value);
    if (knob.type == KnobType::choice) return '"' + text + '"';
    // TOML reads 3 as an integer and 3.0 as a real.
    if (knob.type == KnobType::real && text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
    return text;
}

std::uint64_t settingsHash(const Settings& settings) {
    Hasher hasher;
    for (const Knob& knob : table()) {
        if (knob.group == "draw" && knob.key != "fovy" && knob.key != "near") continue;
        hasher.text(knob.path).number(knob.get(settings));
    }
    return hasher.digest();
}

}  // namespace fb
