#include "build/make_atlas.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "build/bake_charts.h"
#include "build/pack_atlas.h"
#include "build/spread_texels.h"

namespace fb {
namespace {

// How often an atlas that does not fit is made smaller before its texture is given up.
constexpr int kAttempts = 16;

class AtlasMaker {
  public:
    AtlasMaker(std::vector<NodeTriangle>& triangles, const AtlasTask& task)
        : triangles_(triangles), task_(task) {
        for (const NodeTriangle& t : triangles) {
            textured_ = textured_ || t.surface != 0 || t.baked;
            masked_ = masked_ || task.mesh.surfaces[t.surface].alphaMask;
            if (!t.baked) continue;
            FB_CHECK(task.surface != nullptr);
            bakedGridArea_ += 0.5 * glm::length(crossOf(task.mesh.positions[t.positions.x],
                                                        task.mesh.positions[t.positions.y],
                                                        task.mesh.positions[t.positions.z]));
        }
        if (bakedGridArea_ > 0.0) {
            for (const Surface& surface : task.mesh.surfaces) masked_ = masked_ || surface.alphaMask;
        }
    }

    Atlas make() {
        Atlas atlas;
        if (!textured_) return atlas;
        double scale = task_.scale;
        for (int attempt = 0; attempt < kAttempts; ++attempt, scale *= 0.75) {
            ChartSet set = makeCharts(triangles_, task_.mesh, task_.textures, scale);
            if (bakedGridArea_ > 0.0) addBakedCharts(triangles_, task_.mesh, bakedDensity(scale), set);
            AtlasSize size;
            if (!packAtlas(set.charts, task_.maxSide, size)) continue;
            atlas.reduced = attempt > 0;
            atlas.blurredRepeats = set.blurredRepeats;
            atlas.image = fill(set, size, scale);
            for (NodeTriangle& t : triangles_) {
                if (t.chart == kNone) continue;
                const glm::vec2 corner(static_cast<float>(set.charts[t.chart].x),
                                       static_cast<float>(set.charts[t.chart].y));
                for (glm::vec2& texel : t.texels) texel += corner;
            }
            return atlas;
        }
        replaceByColours(scale);
        atlas.replaced = true;
        return atlas;
    }

  private:
    // Texels per grid unit of baked charts. They cover untextured surroundings too, but all of them together
    // never get more than twice the texels that the piece's textured surface is worth.
    [[nodiscard]] double bakedDensity(double scale) const {
        const double share = std::min(1.0, 2.0 * task_.surface->texturedGridArea() / bakedGridArea_);
        return std::max(task_.surface->texelsPerGridUnit() * scale * std::sqrt(share), 1e-9);
    }

    Image fill(const ChartSet& set, const AtlasSize& size, double scale) {
        Image atlas{size.width, size.height, masked_ ? 4 : 3, {}, false};
        const std::size_t texels = static_cast<std::size_t>(size.width) * size.height;
        atlas.pixels.assign(texels * static_cast<std::size_t>(atlas.channels), 255);
        std::vector<std::uint8_t> known(texels, 0);
        for (const Chart& chart : set.charts) {
            if (chart.baked) {
                bakeChart(chart, triangles_, task_.mesh, *task_.surface, bakedDensity(scale), {atlas, known});
            } else {
                copyChart(chart, atlas, known);
            }
        }
        fillUnknown(atlas, known, 0, atlas.channels);
        return atlas;
    }

    void copyChart(const Chart& chart, Image& atlas, std::vector<std::uint8_t>& known) {
        const Surface& surface = task_.mesh.surfaces[chart.surface];
        TextureLevels& texture = *task_.textures.textures[static_cast<std::size_t>(surface.texture)];
        resampleTexture(texture, chart.rect, chart.edge,
                        {atlas, chart.x, chart.y, chart.width, chart.height, kGutter});
        for (int y = std::max(chart.y - kGutter, 0);
             y < std::min(chart.y + chart.height + kGutter, atlas.height); ++y) {
            for (int x = std::max(chart.x - kGutter, 0);
                 x < std::min(chart.x + chart.width + kGutter, atlas.width); ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * atlas.width + x;
                known[at] = 1;
                if (atlas.channels == 4 && !surface.alphaMask) atlas.pixels[at * 4 + 3] = 255;
            }
        }
    }

    void replaceByColours(double scale) {
        const BlockMesh& mesh = task_.mesh;
        for (NodeTriangle& t : triangles_) {
            if (t.surface == 0 && !t.baked) continue;
            const glm::vec3 normal(normalOf(mesh, t.positions));
            for (int k = 0; k < 3; ++k) {
                glm::u8vec4& colour = t.colours[static_cast<std::size_t>(k)];
                if (t.baked) {
                    const glm::vec3 point(mesh.positions[t.positions[k]]);
                    colour = task_.surface->colourAt(task_.surface->closest(point, normal, kNone),
                                                     1.0 / bakedDensity(scale));
                } else {
                    const auto index = static_cast<std::size_t>(mesh.surfaces[t.surface].texture);
                    const TextureSampler texture(*task_.textures.textures[index], static_cast<float>(1.0 / scale));
                    const glm::vec4 texel = texture.at(mesh.wedges[t.wedges[k]].uv);
                    colour = glm::u8vec4(texel * glm::vec4(colour) / 255.0f + 0.5f);
                }
                colour.w = 255;  // holes are finer than a triangle
            }
            t.surface = 0;
            t.baked = false;
            t.chart = kNone;
        }
    }

    std::vector<NodeTriangle>& triangles_;
    const AtlasTask& task_;
    bool textured_ = false, masked_ = false;
    double bakedGridArea_ = 0.0;
};

}  // namespace

Atlas makeAtlas(std::vector<NodeTriangle>& triangles, const AtlasTask& task) {
    return AtlasMaker(triangles, task).make();
}

}  // namespace fb
