#include "control/model_device.h"

#include <algorithm>

#include "base/random.h"

namespace fb {
namespace {

// Mean 0, standard deviation 1, range +-6: the sum of twelve uniforms. Unlike Box and Muller it needs no function
// whose last digit differs between C libraries.
double seededNoise(std::int64_t seed, std::uint64_t frame) {
    Random random = Random::forPart(static_cast<std::uint64_t>(seed), frame);
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
}

}  // namespace

double modelDrawMs(const ModelSettings& settings, const FrameWork& work) {
    const double drawUs = settings.texturedUs * static_cast<double>(work.texturedTriangles) +
                          settings.untexturedUs * static_cast<double>(work.untexturedTriangles) +
                          settings.nodeUs * static_cast<double>(work.nodes);
    return drawUs / 1000.0;
}

double modelFrameMs(const ModelSettings& settings, const FrameWork& work, std::uint64_t frame) {
    const double ms = settings.overheadMs + modelDrawMs(settings, work);
    if (settings.noisePct == 0.0) return ms;
    return std::max(0.0, ms * (1.0 + settings.noisePct / 100.0 * seededNoise(settings.seed, frame)));
}

}  // namespace fb
