#include "select/slow_frame.h"

namespace fb {

void SlowSwitches::record(std::uint64_t frameNumber, NodeId node, bool fine, SlowFrame& frame) {
    fineNow_[node] = fine;
    const auto before = fineBefore_.find(node);
    if (before == fineBefore_.end() || before->second == fine) return;
    ++(fine ? frame.togglesUp : frame.togglesDown);
    const auto last = lastSwitch_.find(node);
    if (last != lastSwitch_.end() && last->second.up != fine && frameNumber - last->second.frame <= 35)
        ++frame.pingPongs;
    lastSwitch_[node] = {frameNumber, fine};
}

void SlowSwitches::keep(NodeId node) {
    const auto before = fineBefore_.find(node);
    if (before != fineBefore_.end()) fineNow_[node] = before->second;
}

void SlowSwitches::endFrame() {
    fineBefore_ = fineNow_;
    fineNow_.clear();
}

bool SlowSwitches::wasFine(NodeId node) const {
    const auto before = fineBefore_.find(node);
    return before != fineBefore_.end() && before->second;
}

}  // namespace fb
