// Durations come from the steady clock; wall-clock time is never subtracted.
#pragma once

#include <chrono>
#include <thread>

namespace fb {

using SteadyClock = std::chrono::steady_clock;

[[nodiscard]] inline double millisecondsSince(SteadyClock::time_point start) {
    return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
}

// Sleeps until `seconds` after `start`; returns at once when that is past.
inline void sleepUntil(SteadyClock::time_point start, double seconds) {
    std::this_thread::sleep_until(
        start + std::chrono::duration_cast<SteadyClock::duration>(std::chrono::duration<double>(seconds)));
}

// Adds the time from construction to destruction to a sum, in milliseconds.
class ScopedMilliseconds {
  public:
    explicit ScopedMilliseconds(double& sumMs) : sumMs_(sumMs), start_(SteadyClock::now()) {}
    ~ScopedMilliseconds() { sumMs_ += millisecondsSince(start_); }
    ScopedMilliseconds(const ScopedMilliseconds&) = delete;
    ScopedMilliseconds& operator=(const ScopedMilliseconds&) = delete;

  private:
    double& sumMs_;
    SteadyClock::time_point start_;
};

// Seconds since `start`, which becomes now.
[[nodiscard]] inline double secondsSinceLap(SteadyClock::time_point& start) {
    const SteadyClock::time_point now = SteadyClock::now();
    const double seconds = std::chrono::duration<double>(now - start).count();
    start = now;
    return seconds;
}

}  // namespace fb
