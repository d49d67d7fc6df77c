#include "build/bake_charts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "build/closest_of_few.h"
#include "build/places_on.h"
#include "build/triangle_texels.h"

namespace fb {
namespace {

// Texels this far outside a triangle are baked with it, so that filtering at its edge finds them.
constexpr float kMargin = 1.5f;
// Texels a side whose closest points are searched together.
constexpr int kSquare = 8;

struct Owner {
    float inside = -kMargin;
    std::uint32_t triangle = kNone;
};

class ChartBaker {
  public:
    ChartBaker(const Chart& chart, std::span<const NodeTriangle> triangles, const BlockMesh& mesh,
               const PieceSurface& surface, double texelsPerGridUnit, const BakeTarget& into)
        : chart_(chart), triangles_(triangles), mesh_(mesh), surface_(surface), into_(into) {
        // A texel is the mean of several points of the original: averaging in the texture instead, by its coarser
        // levels, would mix in what lies beside a chart there. One point for two texels of the original, no more
        // than nine.
        const double texelsAcross = surface.texelsPerGridUnit() / texelsPerGridUnit;
        across_ = std::clamp(static_cast<int>(std::ceil(0.5 * texelsAcross)), 1, 3);
        side_ = 1.0 / (texelsPerGridUnit * across_);
    }

    void bake() {
        findOwners();
        for (int top = 0; top < chart_.height; top += kSquare) {
            for (int left = 0; left < chart_.width; left += kSquare) bakeSquare(left, top);
        }
    }

  private:
    void findOwners() {
        owners_.resize(static_cast<std::size_t>(chart_.width) * static_cast<std::size_t>(chart_.height));
        for (const std::uint32_t i : chart_.triangles) {
            visitTexels(triangles_[i].texels, kMargin, [&](int x, int y, float inside) {
                if (x < 0 || y < 0 || x >= chart_.width || y >= chart_.height) return;
                Owner& owner = owners_[indexOf(x, y)];
                if (inside > owner.inside) owner = {inside, i};
            });
        }
    }

    [[nodiscard]] std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(chart_.width) + static_cast<std::size_t>(x);
    }

    // Texels that lie close together, so that those of one triangle need one search of the original.
    void bakeSquare(int left, int top) {
        texels_.clear();
        for (int y = top; y < std::min(top + kSquare, chart_.height); ++y) {
            for (int x = left; x < std::min(left + kSquare, chart_.width); ++x) {
                const std::uint32_t owner = owners_[indexOf(x, y)].triangle;
                if (owner != kNone) texels_.push_back({owner, {x, y}});
            }
        }
        std::ranges::stable_sort(texels_, {}, &OwnedTexel::owner);
        for (std::size_t begin = 0, end = 0; begin < texels_.size(); begin = end) {
            while (end < texels_.size() && texels_[end].owner == texels_[begin].owner) ++end;
            bakeOwned({texels_.data() + begin, end - begin});
        }
    }

    struct OwnedTexel {
        std::uint32_t owner;  // triangle
        glm::ivec2 at;        // in the chart
    };

    void bakeOwned(std::span<const OwnedTexel> texels) {
        const NodeTriangle& t = triangles_[texels[0].owner];
        const PlacesOn places(t, mesh_);
        points_.clear();
        Box3d box;
        for (const OwnedTexel& texel : texels) {
            points_.push_back(places.at(glm::vec2(texel.at) + 0.5f));
            box.grow(points_.back());
        }
        const glm::dvec3 centre = 0.5 * (box.min + box.max);
        surface_.findCandidates(glm::vec3(centre), static_cast<float>(0.5 * glm::length(box.max - box.min)),
                                glm::vec3(normalOf(mesh_, t.positions)), near_, candidates_);
        search_.clear(centre);
        for (const glm::dvec3& point : points_) search_.add(point);
        corners_.clear();
        for (const std::uint32_t candidate : candidates_) corners_.push_back(surface_.corners(candidate));
        search_.search(corners_);
        shown_.assign(candidates_.size(), std::nullopt);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const ClosestOfFew::Hit hit = search_.hit(i);
            std::optional<Shown>& shown = shown_[hit.triangle];
            if (!shown) {
                shown.emplace(Shown{{surface_, candidates_[hit.triangle], side_},
                                    weightsAlong(corners_[hit.triangle], places.across()),
                                    weightsAlong(corners_[hit.triangle], places.down())});
            }
            write(texels[i].at, colourOf(*shown, hit.weights));
            near_ = candidates_[hit.triangle];
        }
    }

    // A triangle of the original, and by how much the weights of its corners change from a texel to the next.
    struct Shown {
        TriangleColours colours;
        glm::vec3 across, down;
    };

    // The mean over across_ * across_ points of a texel whose centre shows the triangle at `weights`: the other points
    // are looked for on the same triangle.
    [[nodiscard]] glm::u8vec4 colourOf(const Shown& shown, const glm::vec3& weights) const {
        if (across_ == 1) return shown.colours.at(weights);
        glm::uvec4 sum(0u);
        for (int i = 0; i < across_ * across_; ++i) {
            const glm::vec2 off = (glm::vec2(i % across_, i / across_) + 0.5f) / static_cast<float>(across_) - 0.5f;
            const glm::vec3 at = glm::max(weights + off.x * shown.across + off.y * shown.down, glm::vec3(0.0f));
            sum += glm::uvec4(shown.colours.at(at / (at.x + at.y + at.z)));
        }
        const auto count = static_cast<unsigned>(across_ * across_);
        return glm::u8vec4((sum + count / 2) / count);
    }

    void write(const glm::ivec2& texel, const glm::u8vec4& colour) {
        const auto channels = static_cast<std::size_t>(into_.atlas.channels);
        const std::size_t at =
            static_cast<std::size_t>(chart_.y + texel.y) * static_cast<std::size_t>(into_.atlas.width) +
            static_cast<std::size_t>(chart_.x + texel.x);
        into_.known[at] = 1;
        for (std::size_t c = 0; c < channels; ++c) into_.atlas.pixels[at * channels + c] = colour[static_cast<int>(c)];
    }

    const Chart& chart_;
    std::span<const NodeTriangle> triangles_;
    const BlockMesh& mesh_;
    const PieceSurface& surface_;
    BakeTarget into_;
    int across_ = 1;
    double side_ = 0.0;
    std::vector<Owner> owners_;  // by texel of the chart
    std::uint32_t near_ = kNone;
    // Of the texels that are baked together: their points, the triangles that can be closest, and these in turn.
    std::vector<OwnedTexel> texels_;
    std::vector<glm::dvec3> points_;
    std::vector<std::uint32_t> candidates_;
    std::vector<TriangleCorners> corners_;
    std::vector<std::optional<Shown>> shown_;
    ClosestOfFew search_;
};

}  // namespace

void bakeChart(const Chart& chart, std::span<const NodeTriangle> triangles, const BlockMesh& mesh,
               const PieceSurface& surface, double texelsPerGridUnit, const BakeTarget& into) {
    ChartBaker(chart, triangles, mesh, surface, texelsPerGridUnit, into).bake();
}

}  // namespace fb
