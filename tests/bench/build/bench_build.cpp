// bench_build COMMAND [MESH...] [--blocks N] [--block-triangles N] [--samples N] [--rounds N] [--copies N] [--set build.K=V]:
// what model preparation costs and how near it stays to the source. Without a mesh the built-in city is
// prepared. For release builds on a quiet machine.
#include <charconv>
#include <cstdio>
#include <string_view>

#include "commands.h"
#include "settings/knob_table.h"

namespace fb::bench {
namespace {

struct Command {
    const char* name;
    const char* help;
    Result<void> (*run)(const BenchOptions&);
};

constexpr Command kCommands[] = {
    {"simplifiers", "meshoptimizer and OpenMesh by level: triangles, speed, error", timeSimplifiers},
    {"deviation", "levels against plain simplification of the whole to as many triangles", compareDeviation},
    {"ratio", "a whole build in multiples of one plain simplification", compareRatio},
    {"scaling", "cities of 1, 2, 4, … blocks (--blocks: the largest): time, memory", measureScaling},
    {"throughput", "a grid of --copies N x N: triangles and texels a second", measureThroughput}};

struct Option {
    const char* name;
    std::size_t BenchOptions::*value;
};

constexpr Option kOptions[] = {{"--blocks", &BenchOptions::blocks},
                               {"--block-triangles", &BenchOptions::blockTriangles},
                               {"--samples", &BenchOptions::samples},
                               {"--rounds", &BenchOptions::rounds},
                               {"--copies", &BenchOptions::copies}};

bool takeNumber(std::string_view text, std::size_t& into) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), into);
    return problem == std::errc() && end == text.data() + text.size() && into > 0;
}

bool takeKnob(std::string_view text, Settings& settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || !text.starts_with("build.")) return false;
    const Result<void> set = setFromText(settings, text.substr(0, equals), text.substr(equals + 1), "--set");
    if (!set) std::fprintf(stderr, "bench_build: %s\n", set.error().oneLine().c_str());
    return set.has_value();
}

bool takeArguments(int count, char** arguments, BenchOptions& options) {
    for (int i = 2; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (!argument.starts_with("--")) {
            options.meshes.emplace_back(argument);
            continue;
        }
        if (argument == "--set") {
            if (++i == count || !takeKnob(arguments[i], options.settings)) return false;
            continue;
        }
        std::size_t BenchOptions::*value = nullptr;
        for (const Option& option : kOptions) {
            if (argument == option.name) value = option.value;
        }
        if (value == nullptr || ++i == count || !takeNumber(arguments[i], options.*value)) return false;
    }
    return true;
}

int tellUsage() {
    std::fprintf(stderr, "usage: bench_build COMMAND [MESH...]");
    for (const Option& option : kOptions) std::fprintf(stderr, " [%s N]", option.name);
    std::fprintf(stderr, " [--set build.K=V]\n");
    for (const Command& command : kCommands) std::fprintf(stderr, "  %-12s %s\n", command.name, command.help);
    return 2;
}

}  // namespace
}  // namespace fb::bench

int main(int count, char** arguments) {
    using namespace fb::bench;
    BenchOptions options;
    for (const Command& command : kCommands) {
        if (count < 2 || std::string_view(arguments[1]) != command.name) continue;
        if (std::string_view(command.name) == "scaling") options.blocks = 16;
        if (!takeArguments(count, arguments, options)) return tellUsage();
        const auto done = command.run(options);
        if (done) return 0;
        std::fprintf(stderr, "bench_build: %s\n", done.error().oneLine().c_str());
        return 1;
    }
    return tellUsage();
}
