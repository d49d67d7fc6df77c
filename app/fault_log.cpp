#include "app/fault_log.h"

namespace fb {

void FaultLog::hear(const Error& fault) {
    last_ = fault;
    ++held_;
    if (said_ && millisecondsSince(*said_) < 1000.0) return;
    said_ = SteadyClock::now();
    flush();
}

void FaultLog::flush() {
    if (held_ == 0) return;
    if (held_ > 1) last_.reason += " (and " + std::to_string(held_ - 1) + " more like it)";
    held_ = 0;
    say_(last_);
}

}  // namespace fb
