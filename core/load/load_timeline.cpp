#include "load/load_timeline.h"

#include <algorithm>

namespace fb {
namespace {

// A request that was withdrawn and made again before the loader heard of it goes on with what was read before.
void stamp(LoadRecord& record, const LoadStamps& stamps) {
    const auto notBeforeQueued = [&record](double at) { return at < record.queuedAt ? record.queuedAt : at; };
    record.firstReadAt = notBeforeQueued(stamps.firstRead);
    record.readAt = notBeforeQueued(stamps.read);
    record.decodedAt = notBeforeQueued(stamps.decoded);
    record.suspensions = stamps.suspensions;
}

}  // namespace

void LoadTimeline::start(const Hierarchy& hierarchy) {
    const std::size_t nodes = hierarchy.size();
    hierarchy_ = &hierarchy;
    ring_.assign(kCapacity, {});
    begun_ = 0;
    recordOf_.assign(nodes, 0);
    selections_ = 0;
    missedIn_.assign(nodes, 0);
    missedAt_.assign(nodes, 0.0);
    timesLoaded_.assign(nodes, 0);
    notDrawn_.assign(nodes, Arrival::none);
    score_ = {};
}

LoadRecord* LoadTimeline::openRecord(NodeId node) {
    const std::uint64_t number = recordOf_[node];
    if (number == 0 || begun_ - number >= kCapacity) return nullptr;  // none, or overwritten
    LoadRecord& record = ring_[(number - 1) % kCapacity];
    return record.end == LoadEnd::none ? &record : nullptr;
}

void LoadTimeline::close(NodeId node, LoadEnd end, double now) {
    LoadRecord* record = openRecord(node);
    if (record == nullptr) return;
    record->end = end;
    record->endedAt = now;
}

void LoadTimeline::notePlan(const LoadPlan& plan, double now) {
    for (const NodeId node : plan.withdrawn) close(node, LoadEnd::cancelled, now);
    for (const NodeId node : plan.evicted) {
        if (notDrawn_[node] != Arrival::none) {
            ++score_.neverDrawn;
            score_.wastedBytes += hierarchy_->residentBytes[node];
        }
        notDrawn_[node] = Arrival::none;
        close(node, LoadEnd::evicted, now);
    }
    for (const NodeId node : plan.requested) {
        LoadRecord& record = ring_[begun_ % kCapacity];
        record = {};
        record.node = node;
        record.bytes = hierarchy_->residentBytes[node];
        record.queuedAt = now;
        if (isMissed(node)) record.missedAt = missedAt_[node];
        recordOf_[node] = ++begun_;
    }
}

void LoadTimeline::noteUploaded(const LoadStamps& stamps, NodeId node, double now) {
    if (LoadRecord* record = openRecord(node)) {
        stamp(*record, stamps);
        record->uploadedAt = now;
    }
    if (++timesLoaded_[node] > 1) ++score_.reloads;
    score_.mostLoadsOfOne = std::max(score_.mostLoadsOfOne, timesLoaded_[node]);
    notDrawn_[node] = isMissed(node) ? Arrival::late : Arrival::inTime;
    if (!isMissed(node)) return;
    ++score_.late;
    score_.lateSeconds += now - missedAt_[node];
}

void LoadTimeline::noteFailed(const LoadStamps& stamps, NodeId node, double now) {
    if (LoadRecord* record = openRecord(node)) stamp(*record, stamps);
    score_.wastedBytes += hierarchy_->residentBytes[node];
    close(node, LoadEnd::failed, now);
}

void LoadTimeline::noteDrawn(NodeId node, double now) {
    if (notDrawn_[node] == Arrival::none) return;
    if (notDrawn_[node] == Arrival::inTime) ++score_.inTime;
    notDrawn_[node] = Arrival::none;
    if (LoadRecord* record = openRecord(node)) record->firstDrawnAt = now;
}

void LoadTimeline::noteMissed(NodeId node, double now) {
    ++score_.absentNodeFrames;
    if (missedIn_[node] == 0 || missedIn_[node] + 1 != selections_) {
        missedAt_[node] = now;
        if (LoadRecord* record = openRecord(node)) record->missedAt = now;
    }
    missedIn_[node] = selections_;
}

void LoadTimeline::noteSelection(const Selection& selection, const Residency& residency, double now) {
    ++selections_;
    for (const Reached& r : selection.reached) {
        noteDrawn(r.node, now);  // refined ones, too: their children are drawn because they are there
        if (r.expanded || (r.boundBy != BoundBy::load && r.boundBy != BoundBy::memory)) continue;
        const NodeId first = hierarchy_->firstChild[r.node];
        for (NodeId node = first; node < first + hierarchy_->childCount[r.node]; ++node) {
            if (residency.loaded[node] == 0) noteMissed(node, now);
        }
    }
}

std::vector<LoadRecord> LoadTimeline::records() const {
    std::vector<LoadRecord> list;
    const std::uint64_t first = begun_ > kCapacity ? begun_ - kCapacity : 0;
    for (std::uint64_t i = first; i < begun_; ++i) list.push_back(ring_[i % kCapacity]);
    return list;
}

}  // namespace fb
