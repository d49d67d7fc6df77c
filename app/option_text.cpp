#include "app/option_text.h"

#include <charconv>
#include <cmath>

#include "settings/knob_table.h"

namespace fb {
namespace {

bool parseWhole(std::string_view text, int& value) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    return problem == std::errc() && end == text.data() + text.size();
}

// Knobs bound by a common rule may have to pass through a forbidden pair: try again once the others are set.
Result<void> applyOnce(Settings& settings, const std::string& set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) return usageFailure("--set " + set, "has no =", "write NAME=VALUE");
    Result<void> taken = setFromText(settings, set.substr(0, equals), set.substr(equals + 1), "--set");
    if (!taken) taken.error().kind = Error::Kind::usage;
    return taken;
}

}  // namespace

Result<void> applySets(Settings& settings, const std::vector<std::string>& sets) {
    Settings changed = settings;
    for (const std::string& set : sets) {
        if (applyOnce(changed, set)) continue;
        for (const std::string& other : sets) {
            if (&other != &set) static_cast<void>(applyOnce(changed, other));
        }
        if (Result<void> again = applyOnce(changed, set); !again) return again;
    }
    settings = changed;
    return {};
}

Result<void> takePolicy(Settings& settings, const std::string& name) {
    Result<void> taken = setFromText(settings, "select.policy", name, "--policy");
    if (!taken) taken.error().kind = Error::Kind::usage;
    return taken;
}

Result<glm::ivec2> parseSize(const std::string& text) {
    const std::size_t x = text.find('x');
    glm::ivec2 size(0);
    const bool read = x != std::string::npos && parseWhole(std::string_view(text).substr(0, x), size.x) &&
                      parseWhole(std::string_view(text).substr(x + 1), size.y);
    if (!read || size.x < 1 || size.y < 1 || size.x > 16384 || size.y > 16384) {
        return usageFailure("--size " + text, "is not a size", "write WIDTHxHEIGHT, as in 1280x720, each side up to 16384");
    }
    return size;
}

Result<double> parseReal(const std::string& option, const std::string& text) {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return usageFailure(option + " " + text, "is not a finite number", "as in 0.5");
    }
    return value;
}

Result<std::uint64_t> parseCount(const std::string& text) {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string unit(end, text.data() + text.size());
    bool known = true;
    if (unit == "K" || unit == "k") value *= 1e3;
    else if (unit == "M") value *= 1e6;
    else if (unit == "G") value *= 1e9;
    else known = unit.empty();
    value = std::round(value * 1e3) / 1e3;  // 8.95 * 1e6 is not a whole number in binary
    if (problem != std::errc() || !known || !(value >= 0.0 && value <= 1e15) || value != std::floor(value)) {
        return usageFailure(text, "is not a count", "write a whole number such as 480000, 480K or 8.95M");
    }
    return static_cast<std::uint64_t>(value);
}

}  // namespace fb
