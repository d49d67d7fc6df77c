#include "app/progress_display.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "app/guarded_child.h"
#include "base/clock.h"

namespace fb {
namespace {

constexpr int kBarWidth = 30;

struct Display {
    std::mutex mutex;  // builders call from several threads
    SteadyClock::time_point start = SteadyClock::now();
    SteadyClock::time_point shown{};
    std::string phase;
};

bool isTerminal() { return ::isatty(STDERR_FILENO) != 0; }

void printBar(const std::string& phase, double fraction, double elapsedMs) {
    std::string bar(kBarWidth, ' ');
    std::fill_n(bar.begin(), static_cast<int>(fraction * kBarWidth), '#');
    std::string left = "--";
    if (fraction > 0.01) left = std::to_string(static_cast<int>(elapsedMs / 1000.0 * (1.0 - fraction) / fraction)) + " s";
    std::fprintf(stderr, "\r%-12s [%s] %3.0f %%  %s left   ", phase.c_str(), bar.c_str(), 100.0 * fraction, left.c_str());
    std::fflush(stderr);
}

}  // namespace

Progress showProgress(ProgressStyle style) {
    auto display = std::make_shared<Display>();
    return [style, display](std::string_view phase, double fraction) {
        const std::scoped_lock lock(display->mutex);
        fraction = std::clamp(fraction, 0.0, 1.0);
        const bool due = display->phase != phase || millisecondsSince(display->shown) > 100.0 || fraction >= 1.0;
        if (due) {
            display->shown = SteadyClock::now();
            display->phase = phase;
            if (style == ProgressStyle::lines) {
                std::fprintf(stderr, "progress %.4f %s\n", fraction, display->phase.c_str());
                std::fflush(stderr);
            } else if (style == ProgressStyle::bar || (style == ProgressStyle::automatic && isTerminal())) {
                printBar(display->phase, fraction, millisecondsSince(display->start));
            }
        }
        return !stopWanted();
    };
}

void endProgress(ProgressStyle style) {
    if (style == ProgressStyle::bar || (style == ProgressStyle::automatic && isTerminal())) std::fputs("\n", stderr);
}

bool parseProgressLine(const std::string& line, double& fraction, std::string& phase) {
    constexpr std::string_view kHead = "progress ";
    if (!line.starts_with(kHead)) return false;
    const std::size_t space = line.find(' ', kHead.size());
    if (space == std::string::npos) return false;
    fraction = std::strtod(line.c_str() + kHead.size(), nullptr);
    phase = line.substr(space + 1);
    return true;
}

}  // namespace fb
