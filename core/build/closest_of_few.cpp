#include "build/closest_of_few.h"

#include <limits>

namespace fb {

// A triangle as the loop over points needs it.
struct ClosestOfFew::Edges {
    float ax, ay, az;        // first corner
    float bx, by, bz;        // from there to the second
    float cx, cy, cz;        // and to the third
    float bb, bc, cc;        // their products
    float overBb, overCc, overOpposite;  // 1 / squared lengths; 0 where there is none
    float hx, hy, hz;        // from the second corner's edge upright to the third corner, over its squared length
    float foot;              // where that stands on the edge, as a share of it

    Edges(const TriangleCorners& t, const glm::dvec3& centre) {
        const glm::dvec3 a(t[0]), b = glm::dvec3(t[1]) - a, c = glm::dvec3(t[2]) - a, first = a - centre;
        const auto set = [](const glm::dvec3& from, float& x, float& y, float& z) {
            x = static_cast<float>(from.x), y = static_cast<float>(from.y), z = static_cast<float>(from.z);
        };
        const auto over = [](double value) { return value > 0.0 ? 1.0 / value : 0.0; };
        set(first, ax, ay, az), set(b, bx, by, bz), set(c, cx, cy, cz);
        const double lengthB = glm::dot(b, b), lengthC = glm::dot(c, c), share = glm::dot(b, c) * over(lengthB);
        bb = static_cast<float>(lengthB), bc = static_cast<float>(glm::dot(b, c)), cc = static_cast<float>(lengthC);
        overBb = static_cast<float>(over(lengthB));
        overCc = static_cast<float>(over(lengthC));
        overOpposite = static_cast<float>(over(glm::dot(c - b, c - b)));
        // Of needles there are only the edges: h has no direction that could be relied on.
        const glm::dvec3 h = c - share * b;
        const double height = glm::dot(h, h);
        set(height > 1e-10 * lengthC ? h / height : glm::dvec3(0.0), hx, hy, hz);
        foot = static_cast<float>(share);
    }
};

void ClosestOfFew::clear(const glm::dvec3& centre) {
    centre_ = centre;
    lanes_.clear();
    count_ = 0;
}

void ClosestOfFew::add(const glm::dvec3& point) {
    const std::size_t lane = count_ % kLanes;
    if (lane == 0) {
        Lanes& lanes = lanes_.emplace_back();
        lanes.best = Floats{} + std::numeric_limits<float>::infinity();
    }
    const glm::vec3 p(point - centre_);
    Lanes& lanes = lanes_.back();
    lanes.x[lane] = p.x, lanes.y[lane] = p.y, lanes.z[lane] = p.z;
    ++count_;
}

void ClosestOfFew::search(std::span<const TriangleCorners> triangles) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Edges edges(triangles[i], centre_);
        for (Lanes& lanes : lanes_) look(edges, static_cast<std::int32_t>(i), lanes);
    }
}

ClosestOfFew::Hit ClosestOfFew::hit(std::size_t point) const {
    const Lanes& lanes = lanes_[point / kLanes];
    const std::size_t lane = point % kLanes;
    const float v = lanes.second[lane], w = lanes.third[lane];
    return {static_cast<std::uint32_t>(lanes.triangle[lane]), {1.0f - v - w, v, w}};
}

// The foot of the perpendicular where it lies inside, else the closest of the closest points of the three edges.
void ClosestOfFew::look(const Edges& e, std::int32_t number, Lanes& lanes) {
    const Floats none{}, all = none + 1.0f;
    const auto share = [&](const Floats& value) { return value < none ? none : (value > all ? all : value); };
    const Floats px = lanes.x - e.ax, py = lanes.y - e.ay, pz = lanes.z - e.az;
    const Floats d1 = e.bx * px + e.by * py + e.bz * pz;
    const Floats d2 = e.cx * px + e.cy * py + e.cz * pz;
    // Squared distances less that of the first corner.
    const Floats onB = share(d1 * e.overBb), onC = share(d2 * e.overCc);
    const Floats onOpposite = share((d2 - d1 - e.bc + e.bb) * e.overOpposite), rest = 1.0f - onOpposite;
    const Floats atB = onB * (onB * e.bb - 2.0f * d1), atC = onC * (onC * e.cc - 2.0f * d2);
    const Floats atOpposite = rest * (rest * e.bb - 2.0f * d1) +
                              onOpposite * (onOpposite * e.cc + 2.0f * rest * e.bc - 2.0f * d2);
    const Floats least = atC < atB ? atC : atB;
    Floats v = atC < atB ? none : onB, w = atC < atB ? onC : none;
    v = atOpposite < least ? rest : v;
    w = atOpposite < least ? onOpposite : w;
    const Floats footW = e.hx * px + e.hy * py + e.hz * pz, footV = d1 * e.overBb - footW * e.foot;
    const auto inside = (footV > none) & (footW > none) & (footV + footW < all);
    v = inside ? footV : v;
    w = inside ? footW : w;
    const Floats dx = px - v * e.bx - w * e.cx, dy = py - v * e.by - w * e.cy, dz = pz - v * e.bz - w * e.cz;
    const Floats distance = dx * dx + dy * dy + dz * dz;
    const auto closer = distance < lanes.best;
    lanes.best = closer ? distance : lanes.best;
    lanes.second = closer ? v : lanes.second;
    lanes.third = closer ? w : lanes.third;
    lanes.triangle = closer ? Numbers{} + number : lanes.triangle;
}

}  // namespace fb
