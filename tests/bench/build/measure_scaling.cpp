#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "commands.h"
#include "open_source.h"
#include "run_apart.h"
#include "worlds/scratch_folder.h"

namespace fb::bench {
namespace {

Result<BuildNumbers> buildCity(std::size_t blocks, const BenchOptions& options) {
    Result<std::unique_ptr<BlockSource>> source = makeCityOf(blocks, options);
    if (!source) return passOn(source);
    const ScratchFolder folder;
    Result<BuildReport> report = buildScene(**source, options.settings.build, folder.path(), nullptr);
    if (!report) return passOn(report);
    return numbersOf(*report);
}

struct Sample {
    double blocks = 0.0, wall = 0.0, thread = 0.0;
};

// t = a * blocks^exponent by least squares of the logarithms; 1 is linear.
double fittedExponent(const std::vector<Sample>& samples, double Sample::*time) {
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (const Sample& sample : samples) {
        const double x = std::log(sample.blocks), y = std::log(sample.*time);
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Of t = rate * blocks, the rate that makes relative differences least, and the largest of those.
void tellLine(const char* what, const std::vector<Sample>& samples, double Sample::*time) {
    double sum = 0.0, squares = 0.0, worst = 0.0;
    for (const Sample& sample : samples) {
        const double slowness = sample.blocks / (sample.*time);
        sum += slowness;
        squares += slowness * slowness;
    }
    const double rate = sum / squares;
    for (const Sample& sample : samples)
        worst = std::max(worst, std::abs(rate * sample.blocks / (sample.*time) - 1.0));
    std::printf("%s: %.3f s a block, no size off by more than %.1f %%; time ~ blocks^%.3f\n", what, rate,
                100.0 * worst, fittedExponent(samples, time));
}

}  // namespace

Result<void> measureScaling(const BenchOptions& options) {
    const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
    std::printf("scaling: city of %zu triangles a block, %zu threads, best of %zu rounds, a process each\n",
                options.blockTriangles, threads, options.rounds);
    std::printf("%6s %10s %7s %9s %9s %12s %12s %12s %9s\n", "blocks", "triangles", "nodes", "wall s",
                "thread s", "wall s/block", "thread/block", "triangles/s", "peak MiB");
    std::vector<Sample> samples;
    for (std::size_t blocks = 1; blocks <= options.blocks; blocks *= 2) {
        ApartRun best;
        for (std::size_t r = 0; r < options.rounds; ++r) {
            Result<ApartRun> run = runApart([&] { return buildCity(blocks, options); });
            if (!run) return passOn(run);
            const double peak = std::max(best.peakMiB, run->peakMiB);
            if (r == 0 || run->threadSeconds < best.threadSeconds) best = *run;
            best.peakMiB = peak;
        }
        const auto count = static_cast<double>(blocks);
        samples.push_back({count, best.build.seconds, best.threadSeconds});
        std::printf("%6zu %10zu %7zu %9.2f %9.2f %12.3f %12.3f %12.0f %9.0f\n", blocks, best.build.triangles,
                    best.build.nodes, best.build.seconds, best.threadSeconds, best.build.seconds / count,
                    best.threadSeconds / count,
                    static_cast<double>(best.build.triangles) / best.build.seconds, best.peakMiB);
        std::fflush(stdout);
    }
    if (samples.size() < 2) return {};
    tellLine("thread time", samples, &Sample::thread);
    // Fewer blocks than threads leave some idle.
    std::erase_if(samples, [&](const Sample& s) { return s.blocks < static_cast<double>(threads); });
    if (samples.size() >= 2) tellLine("wall time, all threads busy", samples, &Sample::wall);
    return {};
}

}  // namespace fb::bench
