// How long drawing took. In: begin and end of a frame's draws. Out: milliseconds with the number of their
// frame. On a GPU timer queries in a ring, read when they have arrived, never waited for; where all are under
// way a frame goes unmeasured. On a software rasteriser, whose queries are wrong, the frame is finished and
// the wall clock read.
#pragma once

#include <array>
#include <cstdint>

#include "base/clock.h"
#include "draw/gl_objects.h"
#include "draw/renderer.h"

namespace fb {

class FrameTimer {
  public:
    explicit FrameTimer(bool wallClock);

    void begin(std::uint64_t frame);
    void end();
    // The oldest time that has arrived and was not taken yet.
    [[nodiscard]] bool take(DrawTime& time);

  private:
    static constexpr std::size_t kFrames = 8;
    struct Slot {
        GlQuery query;
        std::uint64_t frame = 0;
        double milliseconds = 0.0;  // wall clock only
    };

    bool wallClock_;
    bool measuring_ = false;
    SteadyClock::time_point start_{};
    std::array<Slot, kFrames> slots_;
    std::size_t oldest_ = 0, count_ = 0;  // measured and not taken
};

}  // namespace fb
