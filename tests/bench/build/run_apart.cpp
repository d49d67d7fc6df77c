#include "run_apart.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <type_traits>

namespace fb::bench {
namespace {

static_assert(std::is_trivially_copyable_v<BuildNumbers> &&
              sizeof(BuildNumbers) < 4096);  // one write, not in parts

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void runChild(const std::function<Result<BuildNumbers>()>& work, int into) {
    const Result<BuildNumbers> numbers = work();
    if (!numbers) std::fprintf(stderr, "bench_build: %s\n", numbers.error().oneLine().c_str());
    const bool told = numbers && write(into, &*numbers, sizeof(BuildNumbers)) == sizeof(BuildNumbers);
    _exit(told ? 0 : 1);
}

}  // namespace

BuildNumbers numbersOf(const BuildReport& report) {
    BuildNumbers numbers;
    numbers.blocks = report.blocks;
    numbers.nodes = report.nodes;
    numbers.triangles = report.sourceTriangles;
    numbers.seconds = report.seconds;
    numbers.phases = report.phases;
    numbers.store = report.textures;
    return numbers;
}

Result<ApartRun> runApart(const std::function<Result<BuildNumbers>()>& work) {
    int ends[2];
    if (pipe(ends) != 0) return failure({}, {}, "there is no pipe to be had");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) return failure({}, {}, "there is no process to be had");
    if (child == 0) runChild(work, ends[1]);
    close(ends[1]);
    ApartRun run;
    const bool told = read(ends[0], &run.build, sizeof run.build) == sizeof run.build;
    close(ends[0]);
    rusage usage{};
    int status = 0;
    if (wait4(child, &status, 0, &usage) != child || status != 0 || !told)
        return failure({}, {}, "the build in a child process failed");
    run.threadSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    run.peakMiB = static_cast<double>(usage.ru_maxrss) / 1024.0;
    return run;
}

}  // namespace fb::bench
