#include "control/frame_features.h"

#include <algorithm>

namespace fb {

FrameFeatures featuresOf(const SelectInput& input, const Selection& selection, double megapixels) {
    const auto textured = static_cast<double>(selection.texturedTriangles);
    const auto untextured = static_cast<double>(selection.triangles - selection.texturedTriangles);
    FrameFeatures features;
    features.frame = input.frame;
    features.frontCost = selection.frontCost;
    features.fixedMs = input.time.fixedMs + selection.pressureMs;
    features.estimateMs = selection.estimateMs;
    features.triangles = selection.triangles;
    features.work = {1e-3 * textured, 1e-3 * untextured, static_cast<double>(selection.front.size()), megapixels, 1.0};
    features.refusedGroups = selection.counters.refusedGroups;
    features.onlyRoots = std::ranges::all_of(selection.front, [&](NodeId n) { return n < input.hierarchy.rootCount; });
    features.shareFeedback = input.effects[Effect::shareFeedback];
    return features;
}

void FeatureRing::push(const FrameFeatures& features) {
    ring_[features.frame % ring_.size()] = features;
}

const FrameFeatures* FeatureRing::find(std::uint64_t frame) const {
    const FrameFeatures& kept = ring_[frame % ring_.size()];
    return kept.frame == frame && frame != 0 ? &kept : nullptr;  // 0 marks a place that is still empty
}

}  // namespace fb
