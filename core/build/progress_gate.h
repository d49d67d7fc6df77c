// Tells a caller's progress function how far parallel work is: one thread at a time and with fractions that
// never fall; remembers when it says stop. Used by build_scene and make_blocks.
#pragma once

#include <atomic>
#include <mutex>

#include "import/source_scene.h"

namespace fb {

class ProgressGate {
  public:
    ProgressGate(const Progress& progress, std::size_t blocks) : progress_(progress), blocks_(blocks) {}

    [[nodiscard]] bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
    void stop() { stopped_.store(true, std::memory_order_relaxed); }
    void blockDone() {
        const std::scoped_lock lock(mutex_);
        ++done_;
        tell("build blocks", static_cast<double>(done_) / static_cast<double>(blocks_));
    }
    // From one thread at a time.
    void tell(std::string_view phase, double fraction) {
        if (!progress_ || saidStop_ || progress_(phase, fraction)) return;
        saidStop_ = true;
        stop();
    }

  private:
    const Progress& progress_;
    std::size_t blocks_, done_ = 0;
    std::mutex mutex_;
    std::atomic<bool> stopped_ = false;
    bool saidStop_ = false;  // under mutex_ while blocks are made
};

}  // namespace fb
