#include "control/model_device.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/units.h"

namespace fb {
namespace {

constexpr double kLeastFactor = 0.2;  // of a hidden factor: a device never takes no time
// Each property draws from numbers of its own.
enum Stream : std::uint64_t { kNoise = 0, kDrift = 1, kSpread = 2, kStall = 3 };

Random randomOf(std::int64_t seed, Stream stream, std::uint64_t number) {
    return Random::forPart(static_cast<std::uint64_t>(seed) + 0x51ed2701u * static_cast<std::uint64_t>(stream), number);
}

// Mean 0, standard deviation 1, range +-6: the sum of twelve uniforms. Unlike Box and Muller it needs no function
// whose last digit differs between C libraries.
double normal(std::int64_t seed, Stream stream, std::uint64_t number) {
    Random random = randomOf(seed, stream, number);
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
}

// A new value every drift time, and a smooth way from one to the next. Between two values the sum has a smaller
// deviation than each of them; dividing by that keeps it the same at all times.
double drift(const ModelSettings& settings, std::uint64_t frame) {
    const double at = static_cast<double>(frame) / (settings.rateHz * settings.driftSeconds);
    const auto step = static_cast<std::uint64_t>(at);
    const double t = at - static_cast<double>(step), weight = t * t * (3.0 - 2.0 * t);
    const double sum = (1.0 - weight) * normal(settings.seed, kDrift, step) + weight * normal(settings.seed, kDrift, step + 1);
    return sum / std::sqrt((1.0 - weight) * (1.0 - weight) + weight * weight);
}

double factor(double percent, double deviations) { return std::max(kLeastFactor, 1.0 + percent / 100.0 * deviations); }

}  // namespace

FrameWork modelWork(const ModelSettings& settings, const Hierarchy& hierarchy, std::span<const NodeId> front,
                    double megapixels, std::uint64_t uploadBytes, ModelCounts& counts) {
    FrameWork work;
    work.nodes = front.size();
    work.megapixels = megapixels;
    work.uploadMiB = static_cast<double>(uploadBytes) / kBytesPerMiB;
    for (const NodeId n : front) {
        double hidden = 1.0;
        if (settings.spreadPct > 0.0) {
            ++counts.spread;
            hidden = factor(settings.spreadPct, normal(settings.seed, kSpread, n));
        }
        work.texturedTriangles += hidden * hierarchy.texturedTriangles[n];
        work.untexturedTriangles += hidden * hierarchy.untexturedTriangles[n];
    }
    if (settings.textureMemoryMiB > 0.0) {
        double bytes = 0.0;
        for (const NodeId n : front) bytes += static_cast<double>(hierarchy.textureBytes(n));
        counts.textures += front.size();
        work.textureMiB = std::max(0.0, bytes / kBytesPerMiB - settings.textureMemoryMiB);
    }
    return work;
}

double modelDrawMs(const ModelSettings& settings, const FrameWork& work) {
    const double drawUs = settings.texturedUs * work.texturedTriangles + settings.untexturedUs * work.untexturedTriangles +
                          settings.nodeUs * static_cast<double>(work.nodes);
    return drawUs / 1000.0 + settings.fillMsPerMegapixel * work.megapixels + settings.uploadMsPerMiB * work.uploadMiB +
           settings.thrashMsPerMiB * work.textureMiB;
}

double modelFrameMs(const ModelSettings& settings, const FrameWork& work, std::uint64_t frame, ModelCounts& counts) {
    double ms = settings.overheadMs + modelDrawMs(settings, work);
    if (settings.driftPct > 0.0) {
        ++counts.drift;
        ms *= factor(settings.driftPct, drift(settings, frame));
    }
    if (settings.noisePct > 0.0) {
        ++counts.noise;
        ms *= std::max(0.0, 1.0 + settings.noisePct / 100.0 * normal(settings.seed, kNoise, frame));
    }
    if (settings.stallPct > 0.0) {
        ++counts.stall;
        if (randomOf(settings.seed, kStall, frame).uniform() < settings.stallPct / 100.0) ms += settings.stallMs;
    }
    return ms;
}

}  // namespace fb
