// Durations come from the steady clock; wall-clock time is never subtracted.
#pragma once

#include <chrono>

namespace fb {

using SteadyClock = std::chrono::steady_clock;

[[nodiscard]] inline double millisecondsSince(SteadyClock::time_point start) {
    return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
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

}  // namespace fb
