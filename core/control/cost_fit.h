// The cost model by recursive least squares (algorithms 3.1): a time for each kind of work, learnt slowly from all
// frames, and one fast factor for what the device's speed does right now. Without that factor a slow common drift would
// be pushed into weights that no frame tells apart (a camera that stands still excites none of them) and they diverge.
#pragma once

#include <array>
#include <cstdint>

#include "control/median_gate.h"

namespace fb {

inline constexpr int kWorkKinds = 5;
// Of the drawn front: thousands of textured and of untextured triangles, nodes, covered megapixels, and 1.
using WorkVector = std::array<double, kWorkKinds>;

struct CostFit {
    WorkVector theta{};  // ms per unit of each kind; >= 0, those of triangles at least 1/4 of the prior
    std::array<WorkVector, kWorkKinds> covariance{};
    WorkVector prior{}, priorVariance{};
    double noiseVariance = 1.0;  // ms^2
    double factor = 1.0;         // m: the device's time now over the model's
    MedianGate ratios;           // of actual over modelled
    std::array<double, 8> startRatios{};
    std::uint64_t measured = 0;
};

// ms of each kind to begin with. The first eight frames only set one scale for all of them: a device four times as fast
// as the prior would otherwise never be learnt.
[[nodiscard]] CostFit startCostFit(const WorkVector& prior);
[[nodiscard]] double modelledMs(const CostFit& fit, const WorkVector& work);  // theta . x, without the fast factor
// One measured frame; actualMs is finite and > 0.
void learn(CostFit& fit, const WorkVector& work, double actualMs, std::size_t gateFrames);

}  // namespace fb
