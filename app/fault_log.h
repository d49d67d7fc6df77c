// Faults of loading and drawing, told one line a second however many there are (reliability rule 9).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/clock.h"
#include "base/result.h"

namespace fb {

class FaultLog {
  public:
    using Say = std::function<void(const Error&)>;
    explicit FaultLog(Say say) : say_(std::move(say)) {}

    // Says it at once, or holds it back while less than a second has passed since the line before.
    void hear(const Error& fault);
    // Says the last one held back, with how many there were beside it.
    void flush();

  private:
    Say say_;
    std::optional<SteadyClock::time_point> said_;
    Error last_;
    std::uint64_t held_ = 0;
};

}  // namespace fb
