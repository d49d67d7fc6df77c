// The knob table: every setting as data. Sliders, tooltips, TOML keys, --set, `frontbench knobs` and the
// documentation are made from these rows (knobs/*.def); there is no second list.
// One gate admits values from every source: admit() and setFromText() refuse what is not finite, not in range or
// breaks a rule between two knobs, and leave the settings as they were.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "settings/settings.h"

namespace fb {

enum class KnobType : std::uint8_t { real, integer, boolean, choice };
enum class KnobReruns : std::uint8_t { frame, build };  // what must run again when it changes

struct Knob {
    std::string path;  // "select.c_vis"
    std::string_view group, key, symbol, unit, help, equation;
    KnobType type;
    KnobReruns reruns;
    double initial, low, high;
    std::span<const std::string_view> choices;  // names of the values 0, 1, … of a choice
    double (*get)(const Settings&);             // booleans as 0 and 1, choices as their index
    void (*set)(Settings&, double);             // unchecked: call admit() first
};

// All knobs, grouped, in the order of the .def files.
[[nodiscard]] std::span<const Knob> knobs();
[[nodiscard]] const Knob* findKnob(std::string_view path);  // null when there is none
[[nodiscard]] std::span<const std::string_view> knobGroups();

// Sets the knob or says why not; the settings stay as they were then. `source` names the file or option for the error.
[[nodiscard]] Result<void> admit(Settings& settings, const Knob& knob, double value, std::string_view source);
[[nodiscard]] Result<void> setFromText(Settings& settings, std::string_view path, std::string_view text,
                                       std::string_view source);
// Rules between knobs (c_hystSwitch <= c_hystLimit, …) that a whole preset must keep.
[[nodiscard]] Result<void> checkTogether(const Settings& settings, std::string_view source);

// The value as TOML text: 1.275, 4, true, "lakhia". Reading it back gives the same value.
[[nodiscard]] std::string valueText(const Knob& knob, double value);
// The value as people read it: without quotes.
[[nodiscard]] std::string valueLabel(const Knob& knob, double value);

// Of all knobs that change a replay (all but the view modes of draw.*).
[[nodiscard]] std::uint64_t settingsHash(const Settings& settings);

}  // namespace fb
