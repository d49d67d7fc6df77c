#include "app/build_job.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "app/counted.h"
#include "app/guarded_child.h"
#include "app/progress_display.h"
#include "app/ranks.h"
#include "base/clock.h"
#include "base/folder_lock.h"

namespace fb {
namespace {

void tellNotes(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) std::fprintf(stderr, "note: %s\n", line.c_str());
}

void tell(const BuildReport& report, const std::filesystem::path& folder) {
    std::string line = folder.string() + ": " + counted(report.sourceTriangles, "triangle") + " in " +
                       counted(report.blocks, "block") + " became " + counted(report.nodes, "node");
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, " in %.1f s", report.seconds);
    line += seconds;
    if (report.reusedBlocks > 0) line += ", " + counted(report.reusedBlocks, "block") + " taken over";
    if (report.stuckNodes > 0) line += "; " + counted(report.stuckNodes, "node") + " could not be simplified enough";
    std::fprintf(stderr, "%s\n", line.c_str());
}

void tellPhases(const BuildPhases& phases) {
    std::string line = "thread seconds:";
    for (const NamedPhase& phase : kBuildPhases) {
        char text[48];
        std::snprintf(text, sizeof text, " %s %.2f", phase.name, phases.*phase.seconds);
        line += text;
    }
    std::fprintf(stderr, "%s\n", line.c_str());
}

// Builds with `build` in a child; `tellReport` is called there with what came of it.
Result<void> buildInChild(const BuildJob& job, ProgressStyle progress,
                          const std::function<Result<BuildReport>(const BlockSource&, const Progress&)>& build,
                          const std::function<void(const SourceInfo&, BuildReport&)>& tellReport) {
    return runGuarded(job.what, [&]() -> Result<void> {
        const Progress shown = showProgress(progress);
        Result<std::unique_ptr<BlockSource>> source = job.openSource(shown);
        if (!source) return passOn(source);
        Result<BuildReport> report = build(**source, shown);
        endProgress(progress);
        if (!report) return passOn(report);
        tellReport((*source)->info(), *report);
        return {};
    });
}

Result<void> buildAlone(const BuildJob& job) {
    return buildInChild(
        job, job.progress,
        [&](const BlockSource& source, const Progress& progress) {
            return buildScene(source, job.settings, job.output, progress, job.resources);
        },
        [&](const SourceInfo& info, BuildReport& report) {
            tellNotes(info.report.lines());
            tellNotes(report.warnings);
            tell(report, job.output);
            if (job.phases) tellPhases(report.phases);
        });
}

// What a child lets its parent know.
struct PartFacts {
    std::uint64_t sourceHash = 0, reusedBlocks = 0;
};
class SharedFacts {
  public:
    SharedFacts() {
        void* memory = ::mmap(nullptr, sizeof(PartFacts), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        facts_ = memory == MAP_FAILED ? nullptr : new (memory) PartFacts;
    }
    ~SharedFacts() {
        if (facts_ != nullptr) ::munmap(facts_, sizeof(PartFacts));
    }
    SharedFacts(const SharedFacts&) = delete;
    SharedFacts& operator=(const SharedFacts&) = delete;
    [[nodiscard]] PartFacts* get() const { return facts_; }

  private:
    PartFacts* facts_ = nullptr;
};

class SharedBuild {
  public:
    SharedBuild(const BuildJob& job, const Ranks& ranks) : job_(job), ranks_(ranks) {}

    Result<void> run() {
        if (Result<void> locked = together(lock()); !locked) return locked;
        if (Result<void> built = together(buildShare()); !built) return built;
        if (!ranks_.haveSame(facts_.get()->sourceHash)) {
            if (!ranks_.isFirst()) return tl::make_unexpected(Error{});
            return failure(job_.what, {}, "is not the same on all machines", "each must see the same files");
        }
        reused_ = ranks_.sumOf(facts_.get()->reusedBlocks);
        return together(ranks_.isFirst() ? join() : Result<void>());
    }

  private:
    // Where one rank fails all fail; the others say nothing.
    Result<void> together(Result<void> mine) {
        if (ranks_.agree(mine.has_value())) return {};
        return mine ? tl::make_unexpected(Error{}) : mine;
    }

    Result<void> lock() {
        if (facts_.get() == nullptr) return failure({}, {}, std::string("no shared memory: ") + std::strerror(errno));
        if (!ranks_.isFirst()) return {};
        if (Result<void> made = makeFolder(job_.output); !made) return made;
        Result<FolderLock> taken = FolderLock::take(job_.output);
        if (!taken) return passOn(taken);
        lock_.emplace(std::move(*taken));
        return {};
    }

    Result<void> buildShare() {
        return buildInChild(
            job_, ranks_.isFirst() ? job_.progress : ProgressStyle::none,
            [&](const BlockSource& source, const Progress& progress) {
                facts_.get()->sourceHash = source.info().sourceHash;
                return buildPart(source, job_.settings, job_.output, progress, job_.resources,
                                 {ranks_.index(), ranks_.count()});
            },
            [&](const SourceInfo&, BuildReport& report) {
                facts_.get()->reusedBlocks = report.reusedBlocks;
                tellNotes(report.warnings);
                if (job_.phases) tellPhases(report.phases);
            });
    }

    Result<void> join() {
        return buildInChild(
            job_, job_.progress,
            [&](const BlockSource& source, const Progress& progress) {
                return joinParts(source, job_.settings, job_.output, progress, job_.resources);
            },
            [&](const SourceInfo& info, BuildReport& report) {
                tellNotes(info.report.lines());
                report.reusedBlocks = reused_;
                report.seconds = millisecondsSince(start_) / 1000.0;
                tell(report, job_.output);
            });
    }

    const BuildJob& job_;
    const Ranks& ranks_;
    SteadyClock::time_point start_ = SteadyClock::now();
    SharedFacts facts_;
    std::optional<FolderLock> lock_;  // of the first rank
    std::uint64_t reused_ = 0;
};

}  // namespace

Result<void> runJob(const BuildJob& job) {
    const Result<Ranks> ranks = Ranks::start();
    if (!ranks) return tl::make_unexpected(ranks.error());
    return ranks->count() == 1 ? buildAlone(job) : SharedBuild(job, *ranks).run();
}

}  // namespace fb
