#include "draw/time_frames.h"

#include <epoxy/gl.h>

namespace fb {

FrameTimer::FrameTimer(bool wallClock) : wallClock_(wallClock) {
    if (wallClock_) return;
    for (Slot& slot : slots_) slot.query = GlQuery::make(unsigned{GL_TIME_ELAPSED});
}

void FrameTimer::begin(std::uint64_t frame) {
    measuring_ = wallClock_ || count_ < kFrames;
    if (!measuring_) return;
    if (wallClock_ && count_ == kFrames) {  // nobody takes: the oldest makes room
        oldest_ = (oldest_ + 1) % kFrames;
        --count_;
    }
    Slot& slot = slots_[(oldest_ + count_) % kFrames];
    slot.frame = frame;
    if (wallClock_) {
        glFinish();
        start_ = SteadyClock::now();
    } else {
        glBeginQuery(GL_TIME_ELAPSED, slot.query.name());
    }
}

void FrameTimer::end() {
    if (!measuring_) return;
    Slot& slot = slots_[(oldest_ + count_) % kFrames];
    if (wallClock_) {
        glFinish();
        slot.milliseconds = millisecondsSince(start_);
    } else {
        glEndQuery(GL_TIME_ELAPSED);
    }
    ++count_;
    measuring_ = false;
}

bool FrameTimer::take(DrawTime& time) {
    if (count_ == 0) return false;
    const Slot& slot = slots_[oldest_];
    double milliseconds = slot.milliseconds;
    if (!wallClock_) {
        GLuint available = GL_FALSE;
        glGetQueryObjectuiv(slot.query.name(), GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) return false;
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(slot.query.name(), GL_QUERY_RESULT, &nanoseconds);
        milliseconds = static_cast<double>(nanoseconds) * 1e-6;
    }
    time = {slot.frame, milliseconds};
    oldest_ = (oldest_ + 1) % kFrames;
    --count_;
    return true;
}

}  // namespace fb
