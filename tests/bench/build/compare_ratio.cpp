#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>

#include "base/clock.h"
#include "build/build_scene.h"
#include "commands.h"
#include "open_source.h"
#include "simplify_plainly.h"
#include "worlds/scratch_folder.h"

namespace fb::bench {
namespace {

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double secondsPlain(const WeldedMesh& mesh) {
    SteadyClock::time_point start = SteadyClock::now();
    const std::vector<std::uint32_t> simplified = simplifyPlainly(mesh, mesh.triangles() / 4);
    return simplified.empty() ? 0.0 : secondsSinceLap(start);
}

}  // namespace

Result<void> compareRatio(const BenchOptions& options) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    Result<std::unique_ptr<BlockSource>> source = openSource(options);
    if (!source) return passOn(source);
    Result<std::vector<SourceBlock>> blocks = loadBlocks(**source);
    if (!blocks) return passOn(blocks);
    const WeldedMesh mesh = weldBlocks(*blocks, (*source)->info().bounds.centre());
    blocks->clear();
    // Before and after each build, so that what else the machine does meets both.
    std::vector<double> plain{secondsPlain(mesh)}, whole;
    std::vector<BuildPhases> phases;
    for (std::size_t r = 0; r < options.rounds; ++r) {
        const ScratchFolder folder;
        Result<BuildReport> report = buildScene(**source, options.settings.build, folder.path(), nullptr);
        if (!report) return passOn(report);
        whole.push_back(report->seconds);
        phases.push_back(report->phases);
        plain.push_back(secondsPlain(mesh));
    }
    const double one = medianOf(plain), build = medianOf(whole);
    const auto triangles = static_cast<double>(mesh.triangles());
    std::printf("ratio: %s, %zu triangles in %zu blocks, one thread, medians of %zu rounds\n",
                (*source)->info().name.c_str(), mesh.triangles(), (*source)->blockCount(), options.rounds);
    std::printf("%-22s %10s %14s %9s\n", "", "seconds", "triangles/s", "multiple");
    std::printf("%-22s %10.4f %14.0f %9.2f   (%.4f to %.4f s)\n", "plain to a quarter", one, triangles / one,
                1.0, *std::min_element(plain.begin(), plain.end()),
                *std::max_element(plain.begin(), plain.end()));
    std::printf("%-22s %10.4f %14.0f %9.2f   (%.4f to %.4f s)\n", "whole build", build, triangles / build,
                build / one, *std::min_element(whole.begin(), whole.end()),
                *std::max_element(whole.begin(), whole.end()));
    for (const auto& [name, member] : kBuildPhases) {
        std::vector<double> seconds;
        for (const BuildPhases& p : phases) seconds.push_back(p.*member);
        const double median = medianOf(seconds);
        std::printf("  %-20s %10.4f %14s %9.2f\n", name, median, "", median / one);
    }
    return {};
}

}  // namespace fb::bench
