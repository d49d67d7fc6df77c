// What became of each load, and whether it came in time (thesis 4.3): when it was asked for, read, decoded, uploaded, drawn
// and given up, kept in a ring for the window and the CSV; and a scorecard over all of them. Main thread only. Times are
// seconds of the loader's clock (Loader::nowSeconds).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "load/loader.h"
#include "select/select.h"

namespace fb {

inline constexpr double kNotYet = std::numeric_limits<double>::quiet_NaN();

enum class LoadEnd : std::uint8_t { none, cancelled, failed, evicted };

struct LoadRecord {
    NodeId node = kNoNode;
    std::uint32_t suspensions = 0;  // how often it stepped back for a more urgent one
    std::uint64_t bytes = 0;        // when resident
    double queuedAt = kNotYet, firstReadAt = kNotYet, readAt = kNotYet, decodedAt = kNotYet;
    double uploadedAt = kNotYet, firstDrawnAt = kNotYet;
    double missedAt = kNotYet;  // since when its parent was drawn for want of it; may be before it was asked for
    double endedAt = kNotYet;
    LoadEnd end = LoadEnd::none;
};

// Over all loads since start(). What is loaded and not drawn yet counts nowhere.
struct PrefetchScore {
    std::uint64_t inTime = 0;       // drawn, and not missed when it came
    std::uint64_t late = 0;         // missed in the frame before it came
    double lateSeconds = 0.0;       // for which these had been missed, summed
    std::uint64_t neverDrawn = 0;   // evicted without having been drawn
    std::uint64_t wastedBytes = 0;  // of these, and of loads that failed
    std::uint64_t absentNodeFrames = 0;  // nodes missed, summed over frames; for want of memory too
    std::uint64_t reloads = 0;           // of a node that had been loaded before, and evicted
    std::uint32_t mostLoadsOfOne = 0;    // of the node that was loaded most often
};

class LoadTimeline {
  public:
    // Forgets everything. Loads that are under way or resident already are not known.
    void start(const Hierarchy& hierarchy);

    // After planLoads: what was asked for, withdrawn and evicted in this frame.
    void notePlan(const LoadPlan& plan, double now);
    void noteUploaded(const LoadStamps& stamps, NodeId node, double now);
    void noteFailed(const LoadStamps& stamps, NodeId node, double now);
    // After the selection: what is drawn, and what was missed.
    void noteSelection(const Selection& selection, const Residency& residency, double now);

    // The last kCapacity loads, oldest first.
    [[nodiscard]] std::vector<LoadRecord> records() const;
    [[nodiscard]] const PrefetchScore& score() const { return score_; }

    static constexpr std::size_t kCapacity = 8192;

  private:
    [[nodiscard]] LoadRecord* openRecord(NodeId node);
    [[nodiscard]] bool isMissed(NodeId node) const { return selections_ > 0 && missedIn_[node] == selections_; }
    void noteMissed(NodeId node, double now);
    void close(NodeId node, LoadEnd end, double now);
    void noteDrawn(NodeId node, double now);

    const Hierarchy* hierarchy_ = nullptr;
    std::vector<LoadRecord> ring_;
    std::uint64_t begun_ = 0;                // records ever begun; the newest is at (begun_ - 1) % kCapacity
    std::vector<std::uint64_t> recordOf_;    // of a node's last load: its number from 1; 0: none
    std::uint64_t selections_ = 0;
    std::vector<std::uint64_t> missedIn_;    // the last selection that missed it
    std::vector<double> missedAt_;           // the time of the first of those in a row
    std::vector<std::uint32_t> timesLoaded_;
    enum class Arrival : std::uint8_t { none, inTime, late };
    std::vector<Arrival> notDrawn_;          // how it came, until it is drawn or evicted
    PrefetchScore score_;
};

}  // namespace fb
