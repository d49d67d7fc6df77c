#include "build/join_neighbours.h"

#include <queue>
#include <tuple>

namespace fb {
namespace {

// Parts along the curve, joined with those beside them until `count` runs are left: always the two neighbours
// whose common bounds are smallest.
class RunJoiner {
  public:
    explicit RunJoiner(const std::vector<const Part*>& parts) : runs_(parts.size()) {
        for (std::uint32_t i = 0; i < runs_.size(); ++i) {
            runs_[i] = {i, i + 1, i + 1, i == 0 ? kNone : i - 1, 0, parts[i]->bounds};
        }
        for (std::uint32_t i = 0; i + 1 < runs_.size(); ++i) propose(i);
    }

    // Ends of runs, in order.
    std::vector<std::size_t> join(std::size_t count) {
        for (std::size_t left = runs_.size(); left > count && !queue_.empty();) {
            const Proposal best = queue_.top();
            queue_.pop();
            Joined& run = runs_[best.run];
            if (run.version != best.version || run.next >= runs_.size()) continue;
            if (runs_[run.next].version != best.nextVersion) continue;
            joinNext(best.run);
            --left;
        }
        std::vector<std::size_t> ends;
        for (std::uint32_t i = 0; i < runs_.size(); i = runs_[i].next) ends.push_back(runs_[i].end);
        return ends;
    }

  private:
    struct Joined {
        std::uint32_t begin = 0, end = 0;  // of the parts
        std::uint32_t next = 0, before = kNone;
        std::uint32_t version = 0;
        Box3d bounds;
    };
    struct Proposal {
        double size;
        std::uint32_t run, version, nextVersion;
        bool operator<(const Proposal& other) const {  // the smallest first
            return std::tie(size, run) > std::tie(other.size, other.run);
        }
    };

    void propose(std::uint32_t i) {
        const Joined &run = runs_[i], &next = runs_[run.next];
        Box3d both = run.bounds;
        both.grow(next.bounds.min);
        both.grow(next.bounds.max);
        queue_.push({glm::length(both.size()), i, run.version, next.version});
    }
    void joinNext(std::uint32_t i) {
        Joined& run = runs_[i];
        Joined& gone = runs_[run.next];
        run.bounds.grow(gone.bounds.min);
        run.bounds.grow(gone.bounds.max);
        run.end = gone.end;
        run.next = gone.next;
        ++run.version;
        ++gone.version;
        if (run.next < runs_.size()) {
            runs_[run.next].before = i;
            propose(i);
        }
        if (run.before != kNone) propose(run.before);
    }

    std::vector<Joined> runs_;
    std::priority_queue<Proposal> queue_;
};

}  // namespace

std::vector<std::size_t> joinNeighbours(const std::vector<const Part*>& parts, std::size_t count) {
    return RunJoiner(parts).join(count);
}

}  // namespace fb
