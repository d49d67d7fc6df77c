#include "build/simplify_height_field.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace fb {
namespace {

constexpr std::uint32_t kNobody = ~std::uint32_t{0};

// Sum of w * (n.x * x + n.y * y + n.z * h + d)^2.
struct Quadric {
    double xx = 0, xy = 0, xh = 0, x1 = 0, yy = 0, yh = 0, y1 = 0, hh = 0, h1 = 0, one = 0;

    void add(const glm::dvec3& n, double d, double w) {
        xx += w * n.x * n.x, xy += w * n.x * n.y, xh += w * n.x * n.z, x1 += w * n.x * d;
        yy += w * n.y * n.y, yh += w * n.y * n.z, y1 += w * n.y * d;
        hh += w * n.z * n.z, h1 += w * n.z * d, one += w * d * d;
    }
    void add(const Quadric& q) {
        xx += q.xx, xy += q.xy, xh += q.xh, x1 += q.x1, yy += q.yy, yh += q.yh, y1 += q.y1;
        hh += q.hh, h1 += q.h1, one += q.one;
    }
    [[nodiscard]] double at(const glm::dvec3& p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xh * p.z + x1)) + p.y * (yy * p.y + 2 * (yh * p.z + y1)) +
               p.z * (hh * p.z + 2 * h1) + one;
    }
};

struct Collapse {
    double cost;
    std::uint32_t vertex, stamp;

    bool operator<(const Collapse& other) const {  // the queue's top is the cheapest; of equals the first
        return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
};

class FieldSimplifier {
  public:
    FieldSimplifier(const std::vector<HeightFieldPoint>& points, std::vector<glm::uvec3>&& triangles)
        : points_(points),
          triangles_(std::move(triangles)),
          around_(points.size()),
          quadrics_(points.size()),
          stamps_(points.size(), 0),
          fixed_(points.size(), 0) {
        // One scale for all axes, so that sums of squares keep their digits.
        std::int32_t side = 1;
        for (const HeightFieldPoint& p : points) {
            side = std::max({side, std::abs(p.across - points[0].across), std::abs(p.down - points[0].down)});
        }
        for (const HeightFieldPoint& p : points) {
            places_.emplace_back(glm::dvec3(p.across - points[0].across, p.down - points[0].down,
                                            p.height - points[0].height) /
                                 static_cast<double>(side));
        }
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (int k = 0; k < 3; ++k) around_[triangles_[t][k]].push_back(t);
        }
        left_ = triangles_.size();
        for (const glm::uvec3& t : triangles_) addPlane(t);
        for (std::uint32_t v = 0; v < points.size(); ++v) addOutline(v);
    }

    std::vector<glm::uvec3> run(std::size_t target) {
        for (std::uint32_t v = 0; v < points_.size(); ++v) offer(v);
        while (left_ > target && !queue_.empty()) {
            const Collapse next = queue_.top();
            queue_.pop();
            if (next.stamp != stamps_[next.vertex] || around_[next.vertex].empty()) continue;
            const std::uint32_t onto = bestValid(next.vertex);
            if (onto != kNobody) collapse(next.vertex, onto);
        }
        std::erase_if(triangles_, [](const glm::uvec3& t) { return t.x == kNobody; });
        return std::move(triangles_);
    }

  private:
    void addPlane(const glm::uvec3& t) {
        const glm::dvec3 &a = places_[t.x], &b = places_[t.y], &c = places_[t.z];
        const glm::dvec3 n = glm::cross(b - a, c - a);
        // h as a function of the place: distances along the vertical, not along the normal.
        const glm::dvec3 vertical(n.x / n.z, n.y / n.z, 1.0);
        for (int k = 0; k < 3; ++k) quadrics_[t[k]].add(vertical, -glm::dot(vertical, a), std::abs(n.z));
    }

    // Upright planes along the outlines of holes; points where outlines meet stay.
    void addOutline(std::uint32_t v) {
        gather(v);
        const std::size_t open = neighbours_.size() - around_[v].size();
        if (points_[v].locked || open > 1) fixed_[v] = 1;
        if (open == 0) return;
        for (const std::uint32_t u : neighbours_) {
            if (sharedTriangles(v, u) != 1) continue;
            const glm::dvec3 way = places_[u] - places_[v];
            const double length = std::sqrt(way.x * way.x + way.y * way.y);
            const glm::dvec3 n(way.y / length, -way.x / length, 0.0);
            quadrics_[v].add(n, -glm::dot(n, places_[v]), length * length);
        }
    }

    // The vertices joined to v by an edge, ascending, into neighbours_.
    void gather(std::uint32_t v) { gather(v, neighbours_); }
    void gather(std::uint32_t v, std::vector<std::uint32_t>& into) const {
        into.clear();
        for (const std::uint32_t t : around_[v]) {
            for (int k = 0; k < 3; ++k) {
                if (triangles_[t][k] != v) into.push_back(triangles_[t][k]);
            }
        }
        std::sort(into.begin(), into.end());
        into.erase(std::unique(into.begin(), into.end()), into.end());
    }
    [[nodiscard]] int sharedTriangles(std::uint32_t v, std::uint32_t u) const {
        int shared = 0;
        for (const std::uint32_t t : around_[v]) {
            const glm::uvec3& c = triangles_[t];
            shared += c.x == u || c.y == u || c.z == u ? 1 : 0;
        }
        return shared;
    }
    [[nodiscard]] double cost(std::uint32_t v, std::uint32_t onto) const {
        return quadrics_[v].at(places_[onto]) + quadrics_[onto].at(places_[onto]);
    }

    void offer(std::uint32_t v) {
        ++stamps_[v];
        if (fixed_[v] != 0 || around_[v].empty()) return;
        gather(v);
        double best = cost(v, neighbours_.front());
        for (const std::uint32_t u : neighbours_) best = std::min(best, cost(v, u));
        queue_.push({best, v, stamps_[v]});
    }

    // The cheapest neighbour that v may become; the others come later, when something around v has changed.
    std::uint32_t bestValid(std::uint32_t v) {
        gather(v);
        const bool onOutline = neighbours_.size() != around_[v].size();
        ranked_.clear();
        for (const std::uint32_t u : neighbours_) ranked_.push_back({cost(v, u), u});
        std::sort(ranked_.begin(), ranked_.end());
        for (const auto& [price, u] : ranked_) {
            const int shared = sharedTriangles(v, u);
            if (onOutline && shared != 1) continue;
            if (common(u) == shared && staysUpright(v, u)) return u;
        }
        return kNobody;
    }
    // How many of neighbours_ are neighbours of u too: as many as triangles shared, or surfaces would touch.
    int common(std::uint32_t u) {
        gather(u, others_);
        int count = 0;
        auto at = others_.begin();
        for (const std::uint32_t n : neighbours_) {
            at = std::lower_bound(at, others_.end(), n);
            count += at != others_.end() && *at == n ? 1 : 0;
        }
        return count;
    }
    [[nodiscard]] bool staysUpright(std::uint32_t v, std::uint32_t u) const {
        return std::ranges::all_of(around_[v], [&](std::uint32_t t) {
            glm::uvec3 c = triangles_[t];
            if (c.x == u || c.y == u || c.z == u) return true;
            for (int k = 0; k < 3; ++k) c[k] = c[k] == v ? u : c[k];
            return planArea(points_[c.x], points_[c.y], points_[c.z]) < 0;
        });
    }

    void collapse(std::uint32_t v, std::uint32_t u) {
        for (const std::uint32_t t : around_[v]) {
            glm::uvec3& c = triangles_[t];
            if (c.x == u || c.y == u || c.z == u) {
                for (int k = 0; k < 3; ++k) {
                    if (c[k] != v) std::erase(around_[c[k]], t);
                }
                c = glm::uvec3(kNobody);
                --left_;
            } else {
                for (int k = 0; k < 3; ++k) c[k] = c[k] == v ? u : c[k];
                around_[u].push_back(t);
            }
        }
        around_[v].clear();
        quadrics_[u].add(quadrics_[v]);
        gather(u, changed_);
        changed_.push_back(u);
        for (const std::uint32_t n : changed_) offer(n);
    }

    const std::vector<HeightFieldPoint>& points_;
    std::vector<glm::uvec3> triangles_;               // x == kNobody: gone
    std::vector<std::vector<std::uint32_t>> around_;  // by vertex: its triangles
    std::vector<Quadric> quadrics_;
    std::vector<std::uint32_t> stamps_;  // by vertex: offers with another stamp are out of date
    std::vector<std::uint8_t> fixed_;
    std::vector<glm::dvec3> places_;
    std::priority_queue<Collapse> queue_;
    std::size_t left_ = 0;
    std::vector<std::uint32_t> neighbours_, others_, changed_;
    std::vector<std::pair<double, std::uint32_t>> ranked_;
};

}  // namespace

std::vector<glm::uvec3> simplifyHeightField(const std::vector<HeightFieldPoint>& points,
                                            std::vector<glm::uvec3> triangles, std::size_t target) {
    if (triangles.size() <= target) return triangles;
    return FieldSimplifier(points, std::move(triangles)).run(target);
}

}  // namespace fb
