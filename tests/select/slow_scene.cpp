#include "select/slow_scene.h"

#include <cmath>

#include "select/screen_error.h"
#include "select/slow_look.h"

namespace fb {
namespace {

// t(n) of algorithms 3.1, without textures that do not fit.
double slowTimeMs(const SelectInput& in, NodeId n) {
    const TimeModel& t = in.time;
    const double ms = t.texturedMs * in.hierarchy.texturedTriangles[n] +
                      t.untexturedMs * in.hierarchy.untexturedTriangles[n] + t.nodeMs;
    return std::max(1e-12, std::max(t.leastMs, ms));
}

// Half the edge of a texel, in metres (algorithms 3, "Gain").
double halfTexel(const Hierarchy& h, NodeId n) {
    const double texels = 1.0 * h.textureWidth[n] * h.textureHeight[n];
    return texels > 0.0 ? 0.5 * std::sqrt(h.areaSquareMetres[n] / texels) : 0.0;
}

// By how much less how many pixels are wrong when this child is drawn.
double pixelGain(const SelectInput& in, NodeId parent, NodeId child) {
    const Hierarchy& h = in.hierarchy;
    const double shapeBefore = h.geometricErrorMetres[parent], textureBefore = halfTexel(h, parent);
    if (shapeBefore + textureBefore <= 0.0) return 0.0;
    double finer = 0.0;
    if (h.geometricErrorMetres[child] < shapeBefore) finer += shapeBefore - h.geometricErrorMetres[child];
    if (halfTexel(h, child) < textureBefore) finer += textureBefore - halfTexel(h, child);
    const double away = slowSurfaceDistance(h, child, in.view.camera.eye);
    const double perMetre = in.view.pixelsPerUnit / std::max(0.001, away);
    const double pixels = std::min(double(in.view.width) * in.view.height, h.areaSquareMetres[child] * perMetre * perMetre);
    const double nearest = std::max(0.001, away - shapeBefore - textureBefore);
    const double wrong = std::min(std::hypot(in.view.width, in.view.height),
                                  (shapeBefore + textureBefore) * in.view.pixelsPerUnit / nearest);
    return pixels * wrong * finer / (shapeBefore + textureBefore);
}

}  // namespace

SlowScene::SlowScene(const SelectInput& input) : in(input) {
    for (NodeId n = 0; n < in.hierarchy.rootCount; ++n) {
        const double outside = slowOutside(in.view, in.hierarchy.bounds[n]);
        if (outside > 0.0) continue;
        roots.push_back(n);
        look(n, outside);
    }
}

void SlowScene::look(NodeId n, double outside) {
    const Hierarchy& h = in.hierarchy;
    SlowNode& node = nodes_[n];
    node.timeMs = slowTimeMs(in, n);
    double priority = slowPriority(in, n, outside);
    if (!std::isfinite(priority) || priority <= 0.0) priority = 1e-12;
    node.benefit = priority * slowCost(in, n);
    node.errorPixels = nodeErrorPixels(h, n, in.view);
    node.triangles = std::int64_t{h.texturedTriangles[n]} + h.untexturedTriangles[n];
    if (h.childCount[n] == 0) return;
    for (NodeId child = h.firstChild[n]; child < h.firstChild[n] + h.childCount[n]; ++child) {
        const double childOutside = slowOutside(in.view, h.bounds[child]);
        if (childOutside > 0.0) continue;
        node.children.push_back(child);
        look(child, childOutside);
    }
    if (node.children.empty()) {
        node.unusable = BoundBy::view;
        return;
    }
    bool loaded = true, noRoom = false;
    for (NodeId child = h.firstChild[n]; child < h.firstChild[n] + h.childCount[n]; ++child) {
        if (!in.settings.needAllChildren && !nodes_.contains(child)) continue;
        if (in.loaded[child] == 0) loaded = false;
        if (in.memoryRefused[child] != 0) noRoom = true;
    }
    node.usable = loaded;
    node.unusable = noRoom ? BoundBy::memory : BoundBy::load;
    weighRefinement(n);
}

// extra, gain and value of algorithms 2.1, with the gain of algorithms 3 where it asks for that.
void SlowScene::weighRefinement(NodeId n) {
    const Hierarchy& h = in.hierarchy;
    const bool byPixels =
        in.settings.policy == PolicyId::frontbench && in.settings.gainMeasure == GainMeasure::error;
    SlowNode& node = nodes_[n];
    double childrenMs = 0.0, gain = 0.0;
    for (NodeId k : node.children) {
        const SlowNode& child = nodes_.at(k);
        childrenMs += child.timeMs;
        node.extraTriangles += child.triangles;
        double factor = 0.02;
        const double own = h.staticBenefit[k];
        if (own > 0.0) factor = std::max(0.02, 1.0 - (double{h.staticBenefit[n]} / h.childCount[n]) / own);
        gain += byPixels ? pixelGain(in, n, k) : child.benefit * factor;
    }
    node.extraTriangles -= node.triangles;
    node.extraMs = childrenMs - node.timeMs;
    const double value = node.extraMs <= 0.0 ? 1000.0 * gain : gain / std::max(node.extraMs, 1e-3);
    node.value = std::min(value, 1e300);
}

bool SlowScene::below(double a, double b) {
    if (a != b && std::isfinite(a) && std::isfinite(b) &&
        std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)))
        hungOnRounding = true;
    return a < b;
}

SlowSet SlowScene::reached(const std::vector<NodeId>& from, const SlowSet& refined) const {
    SlowSet all;
    for (NodeId n : from) {
        all.insert(n);
        if (refined.contains(n)) all.merge(reached((*this)[n].children, refined));
    }
    return all;
}

SlowSet SlowScene::drawn(const std::vector<NodeId>& from, const SlowSet& refined) const {
    SlowSet some;
    for (NodeId n : reached(from, refined)) {
        if (!refined.contains(n)) some.insert(n);
    }
    return some;
}

SlowSet SlowScene::refinable(const std::vector<NodeId>& from, const SlowSet& refined) const {
    SlowSet some;
    for (NodeId n : drawn(from, refined)) {
        if ((*this)[n].usable) some.insert(n);
    }
    return some;
}

SlowSet SlowScene::innermost(const SlowSet& refined) const {
    SlowSet some;
    for (NodeId n : refined) {
        bool above = false;
        for (NodeId child : (*this)[n].children) above = above || refined.contains(child);
        if (!above) some.insert(n);
    }
    return some;
}

double SlowScene::totalMs(const SlowSet& drawn) const {
    double total = in.time.fixedMs;
    for (NodeId n : drawn) total += (*this)[n].timeMs;
    return total;
}

}  // namespace fb
