#include "build/find_islands.h"

#include <algorithm>
#include <cmath>

#include "build/cover_texels.h"
#include "build/make_charts.h"

namespace fb {
namespace {

// An island is cut when that saves this share of its room and this many texels of the atlas: each cut repeats vertices.
constexpr double kLeastSavedShare = 0.04, kLeastSavedTexels = 128.0;

struct Box2 {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void grow(const Box2& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

// A triangle in its texture, in texels.
struct FlatTriangle {
    std::uint32_t index = 0;
    Box2 box;
};

class IslandFinder {
  public:
    IslandFinder(std::span<NodeTriangle> triangles, const BlockMesh& mesh, const BlockTextures& textures,
                 double scale)
        : triangles_(triangles), mesh_(mesh), textures_(textures), scale_(scale) {}

    std::vector<Island> run() {
        for (std::vector<FlatTriangle>& connected : findConnected()) cut(connected);
        return std::move(islands_);
    }

  private:
    // In the order of their first triangles.
    std::vector<std::vector<FlatTriangle>> findConnected() {
        Joiner joiner(triangles_.size());
        std::vector<std::uint32_t> wedges;  // of textured triangles
        for (const NodeTriangle& t : triangles_) {
            if (t.surface != 0) wedges.insert(wedges.end(), {t.wedges.x, t.wedges.y, t.wedges.z});
        }
        std::sort(wedges.begin(), wedges.end());
        wedges.erase(std::unique(wedges.begin(), wedges.end()), wedges.end());
        std::vector<std::uint32_t> first(wedges.size(), kNone);  // triangle that uses the wedge
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (triangles_[i].surface == 0) continue;
            for (int k = 0; k < 3; ++k) {
                const auto at = static_cast<std::size_t>(
                    std::lower_bound(wedges.begin(), wedges.end(), triangles_[i].wedges[k]) - wedges.begin());
                first[at] = first[at] == kNone ? i : joiner.join(first[at], i);
            }
        }
        std::vector<std::vector<FlatTriangle>> connected;
        std::vector<std::uint32_t> numberOf(triangles_.size(), kNone);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (triangles_[i].surface == 0) continue;
            std::uint32_t& number = numberOf[joiner.find(i)];
            if (number == kNone) {
                number = static_cast<std::uint32_t>(connected.size());
                connected.emplace_back();
            }
            connected[number].push_back({i, boxOf(i)});
        }
        return connected;
    }

    [[nodiscard]] Box2 boxOf(std::uint32_t triangle) const {
        const NodeTriangle& t = triangles_[triangle];
        const glm::dvec2 size = textureSize(mesh_.surfaces[t.surface], textures_);
        Box2 box;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 at = glm::dvec2(mesh_.wedges[t.wedges[k]].uv) * size;
            box.grow({at, at});
        }
        return box;
    }

    [[nodiscard]] bool keepsMipBlocks(const TexelRect& rect) const {
        return scale_ == 1.0 && std::min(rect.width, rect.height) >= kLeastAlignedSide;
    }

    [[nodiscard]] double roomOf(const Box2& box, bool mustKeepMipBlocks) const {
        const TexelRect rect = rectOf(box.low, box.high);
        if (keepsMipBlocks(rect)) return atlasTexels(alignedToBlocks(rect), scale_);
        // A small part of a chart that keeps its blocks would lose them.
        return mustKeepMipBlocks ? std::numeric_limits<double>::infinity() : atlasTexels(rect, scale_);
    }

    void cut(std::span<FlatTriangle> part) {
        Box2 whole;
        for (const FlatTriangle& t : part) whole.grow(t.box);
        const bool aligned = keepsMipBlocks(rectOf(whole.low, whole.high));
        const double room = roomOf(whole, aligned);
        const double most = room - std::max(kLeastSavedShare * room, kLeastSavedTexels);
        double least = most;
        std::size_t bestCount = 0;
        int bestAxis = 0;
        for (int axis = 0; axis < 2 && most > 0.0; ++axis) {
            sortAlong(part, axis);
            std::vector<Box2> behind(part.size() + 1);
            for (std::size_t i = part.size(); i-- > 0;) {
                behind[i] = behind[i + 1];
                behind[i].grow(part[i].box);
            }
            Box2 before;
            for (std::size_t count = 1; count < part.size(); ++count) {
                before.grow(part[count - 1].box);
                const double both = roomOf(before, aligned) + roomOf(behind[count], aligned);
                if (both >= least) continue;
                least = both;
                bestCount = count;
                bestAxis = axis;
            }
        }
        if (bestCount == 0) {
            add(part, whole);
            return;
        }
        if (bestAxis == 0) sortAlong(part, 0);
        cut(part.first(bestCount));
        cut(part.subspan(bestCount));
    }

    static void sortAlong(std::span<FlatTriangle> part, int axis) {
        std::sort(part.begin(), part.end(), [&](const FlatTriangle& a, const FlatTriangle& b) {
            const double s = a.box.low[axis] + a.box.high[axis], t = b.box.low[axis] + b.box.high[axis];
            return s != t ? s < t : a.index < b.index;
        });
    }

    void add(std::span<const FlatTriangle> part, const Box2& box) {
        const std::uint32_t surface = triangles_[part[0].index].surface;
        const glm::dvec2 size = textureSize(mesh_.surfaces[surface], textures_);
        const glm::dvec2 shift = glm::floor((box.low + kTexelTolerance) / size) * size;
        for (const FlatTriangle& t : part) triangles_[t.index].chart = static_cast<std::uint32_t>(islands_.size());
        islands_.push_back({surface, box.low - shift, box.high - shift, shift});
    }

    std::span<NodeTriangle> triangles_;
    const BlockMesh& mesh_;
    const BlockTextures& textures_;
    double scale_;
    std::vector<Island> islands_;
};

}  // namespace

glm::dvec2 textureSize(const Surface& surface, const BlockTextures& textures) {
    const TextureLevels& texture = *textures.textures[static_cast<std::size_t>(surface.texture)];
    return {texture.width(), texture.height()};
}

TexelRect rectOf(const glm::dvec2& low, const glm::dvec2& high) {
    const glm::dvec2 first = glm::floor(low + kTexelTolerance);
    const glm::dvec2 end = glm::max(first + 1.0, glm::ceil(high - kTexelTolerance));
    return {first.x, first.y, end.x - first.x, end.y - first.y};
}

TexelRect alignedToBlocks(const TexelRect& rect) {
    const auto down = [](double at) { return std::floor(at / kMipBlock) * kMipBlock; };
    const double x = down(rect.x), y = down(rect.y);
    return {x, y, down(rect.x + rect.width + kMipBlock - 1.0) - x,
            down(rect.y + rect.height + kMipBlock - 1.0) - y};
}

double atlasTexels(const TexelRect& rect, double scale) {
    return (std::max(1.0, rect.width * scale) + 2 * kGutter) *
           (std::max(1.0, rect.height * scale) + 2 * kGutter);
}

std::vector<Island> findIslands(std::span<NodeTriangle> triangles, const BlockMesh& mesh,
                                const BlockTextures& textures, double scale) {
    return IslandFinder(triangles, mesh, textures, scale).run();
}

}  // namespace fb
