// draw_levels SCENE FOLDER [--block N]: pictures to look at, and cracks counted.
//   levels.png   the block (0 when left out) at each level, from the root to the leaves; below, with triangle edges
//   mixed-*.png  the whole scene with neighbours of different levels side by side, from three distances, there where
//                most cracks are: as it is, coloured by level, and with the cracks in magenta
// A crack is a pixel where the mixed front shows the sky and no front of a single level does. Needs memory for the whole
// scene.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "app/frame.h"
#include "app/save_picture.h"
#include "base/program_folder.h"
#include "draw/offscreen_context.h"
#include "settings/knob_table.h"

namespace {

using namespace fb;

constexpr int kSide = 640, kViews = 12;
constexpr double kDistances[] = {1.6, 0.7, 0.2};  // of the scene's diagonal

int fail(const Error& error) {
    std::fprintf(stderr, "draw_levels: %s\n", error.oneLine().c_str());
    return 1;
}

class Album {
  public:
    explicit Album(Workbench& workbench) : w_(workbench), hierarchy_(workbench.scene->hierarchy) {}

    Image draw(const std::vector<NodeId>& front, const Camera& camera, bool edges,
               ColourMode colour = ColourMode::scene) {
        DrawSettings settings = w_.settings.draw;
        settings.wireframe = edges;
        settings.colour = colour;
        const View view = makeView(camera, glm::dvec3(0.0), kSide, kSide);
        w_.renderer->draw({hierarchy_, front, view, settings, w_.effects, glm::vec3(w_.scene->info.upVector())}, 0);
        return w_.renderer->readPicture();
    }

    // Of the block, or of all blocks for none; leaves stand for deeper levels.
    std::vector<NodeId> levelFront(std::uint8_t level, std::optional<std::uint32_t> block) const {
        std::vector<NodeId> front;
        for (NodeId n = 0; n < hierarchy_.size(); ++n) {
            if (block && hierarchy_.block[n] != *block) continue;
            const bool isDrawn = hierarchy_.level[n] == level || (hierarchy_.isLeaf(n) && hierarchy_.level[n] < level);
            if (isDrawn) front.push_back(n);
        }
        return front;
    }

    // Every other node is refined, so that levels meet all over the scene.
    std::vector<NodeId> mixedFront() const {
        std::vector<NodeId> front;
        for (NodeId root = 0; root < hierarchy_.rootCount; ++root) refine(root, root % 2 == 0, front);
        return front;
    }

    Camera around(const glm::dvec3& centre, double distance, int view) const {
        const glm::dvec3 up(w_.scene->info.upVector());
        const glm::dvec3 side = std::abs(up.y) > 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const double angle = 2.0 * 3.14159265358979 * view / kViews;
        const glm::dvec3 ahead = std::cos(angle) * side + std::sin(angle) * glm::cross(up, side);
        return lookAt(centre + distance * glm::normalize(ahead + 0.6 * up), centre, up);
    }

  private:
    void refine(NodeId node, bool isRefined, std::vector<NodeId>& front) const {
        if (!isRefined || hierarchy_.isLeaf(node)) {
            front.push_back(node);
            return;
        }
        for (std::uint32_t c = 0; c < hierarchy_.childCount[node]; ++c)
            refine(hierarchy_.firstChild[node] + c, c % 2 == 0, front);
    }

    Workbench& w_;
    const Hierarchy& hierarchy_;
};

// Pictures of one size beside each other, in rows.
Image joinPictures(const std::vector<std::vector<Image>>& rows) {
    const Image& first = rows[0][0];
    Image all{first.width * static_cast<int>(rows[0].size()), first.height * static_cast<int>(rows.size()), 3, {}, false};
    for (const std::vector<Image>& row : rows) {
        for (int y = 0; y < first.height; ++y) {
            for (const Image& image : row) {
                const auto* const line = image.pixels.data() + static_cast<std::size_t>(y) * first.width * 3;
                all.pixels.insert(all.pixels.end(), line, line + static_cast<std::size_t>(first.width) * 3);
            }
        }
    }
    return all;
}

struct Fronts {
    std::vector<NodeId> mixed;
    std::vector<std::vector<NodeId>> levels;
};

bool isSame(const Image& a, const Image& b, std::size_t pixel) {
    return std::memcmp(a.pixels.data() + pixel * 3, b.pixels.data() + pixel * 3, 3) == 0;
}

Result<void> drawBlock(Album& album, const Workbench& w, std::uint32_t block, const std::filesystem::path& folder) {
    const Hierarchy& h = w.scene->hierarchy;
    Box3f bounds;
    std::uint8_t deepest = 0;
    for (NodeId n = 0; n < h.size(); ++n) {
        if (h.block[n] != block) continue;
        bounds.grow(h.bounds[n]);
        deepest = std::max(deepest, h.level[n]);
    }
    const glm::dvec3 centre = 0.5 * glm::dvec3(bounds.min + bounds.max);
    const Camera camera = album.around(centre, 1.1 * glm::length(glm::dvec3(bounds.max - bounds.min)), 1);
    std::vector<std::vector<Image>> rows(2);
    for (std::uint8_t level = 0; level <= deepest; ++level) {
        const std::vector<NodeId> front = album.levelFront(level, block);
        std::uint64_t triangles = 0;
        for (const NodeId n : front) triangles += h.triangles(n);
        std::printf("block %u level %d: %zu nodes, %llu triangles\n", block, level, front.size(),
                    static_cast<unsigned long long>(triangles));
        rows[0].push_back(album.draw(front, camera, false));
        rows[1].push_back(album.draw(front, camera, true));
    }
    return savePicture(joinPictures(rows), folder / "levels.png");
}

// Pixels where the mixed front shows the sky and no front of a single level does.
std::vector<std::size_t> findCracks(Album& album, const Fronts& fronts, const Camera& camera) {
    const Image sky = album.draw({}, camera, false), shown = album.draw(fronts.mixed, camera, false);
    std::vector<std::size_t> cracks;
    for (std::size_t pixel = 0; pixel < sky.pixels.size() / 3; ++pixel) {
        if (isSame(shown, sky, pixel)) cracks.push_back(pixel);
    }
    for (const std::vector<NodeId>& level : fronts.levels) {
        const Image single = album.draw(level, camera, false);
        std::erase_if(cracks, [&](std::size_t pixel) { return isSame(single, sky, pixel); });
    }
    return cracks;
}

Image markPixels(Image image, const std::vector<std::size_t>& pixels) {
    for (const std::size_t pixel : pixels) {
        const int x = static_cast<int>(pixel) % image.width, y = static_cast<int>(pixel) / image.width;
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx) {
                if (x + dx < 0 || y + dy < 0 || x + dx >= image.width || y + dy >= image.height) continue;
                const std::size_t at = (static_cast<std::size_t>(y + dy) * image.width + (x + dx)) * 3;
                image.pixels[at] = image.pixels[at + 2] = 255;
                image.pixels[at + 1] = 0;
            }
        }
    }
    return image;
}

Result<void> drawMixed(Album& album, const Workbench& w, const std::filesystem::path& folder) {
    const Box3d& bounds = w.scene->info.bounds;
    Fronts fronts{album.mixedFront(), {}};
    for (std::uint8_t level = 0; level <= w.scene->hierarchy.maxLevel(); ++level)
        fronts.levels.push_back(album.levelFront(level, std::nullopt));
    for (const double distance : kDistances) {
        std::vector<std::size_t> worst;
        std::size_t all = 0;
        Camera camera = album.around(bounds.centre(), distance * bounds.diagonal(), 1);
        for (int v = 0; v < kViews; ++v) {
            const Camera here = album.around(bounds.centre(), distance * bounds.diagonal(), v);
            std::vector<std::size_t> cracks = findCracks(album, fronts, here);
            all += cracks.size();
            if (cracks.size() <= worst.size()) continue;
            worst = std::move(cracks);
            camera = here;
        }
        std::printf("mixed front of %zu nodes from %.1f of the diagonal: %zu pixels of cracks in %d pictures of %d x %d\n",
                    fronts.mixed.size(), distance, all, kViews, kSide, kSide);
        const Image scene = album.draw(fronts.mixed, camera, false);
        const Image levels = album.draw(fronts.mixed, camera, false, ColourMode::level);
        const std::string name = "mixed-" + std::to_string(std::lround(100.0 * distance)) + ".png";
        if (Result<void> saved = savePicture(joinPictures({{scene, levels, markPixels(scene, worst)}}), folder / name);
            !saved) {
            return saved;
        }
    }
    return {};
}

}  // namespace

int main(int count, char** arguments) {
    std::uint32_t block = 0;
    bool isUsage = count == 3;
    if (count == 5 && std::string_view(arguments[3]) == "--block") {
        const std::string_view text = arguments[4];
        isUsage = std::from_chars(text.data(), text.data() + text.size(), block).ec == std::errc();
    }
    if (!isUsage) {
        std::fprintf(stderr, "usage: draw_levels SCENE FOLDER [--block N]\n");
        return 2;
    }
    auto context = OffscreenContext::create();
    if (!context) return fail(context.error());
    Workbench w;
    w.clock = ClockKind::model;
    w.settings.select.policy = PolicyId::full;
    w.settings.load.budgetMiB = findKnob("load.budget")->high;
    auto renderer = Renderer::create(programFolder() / "shaders");
    if (!renderer) return fail(renderer.error());
    w.renderer = std::move(*renderer);
    if (auto opened = openScene(w, arguments[1]); !opened) return fail(opened.error());
    if (block >= w.scene->hierarchy.grids.size()) {
        std::fprintf(stderr, "draw_levels: the scene has %zu blocks\n", w.scene->hierarchy.grids.size());
        return 1;
    }
    Album album(w);
    FrameInput input;
    input.width = input.height = kSide;
    input.camera = album.around(w.scene->info.bounds.centre(), 2.0 * w.scene->info.bounds.diagonal(), 0);
    settle(w, input, 1e4);
    runFrame(w, input);
    const std::filesystem::path folder = arguments[2];
    if (auto made = makeFolder(folder); !made) return fail(made.error());
    if (auto drawn = drawBlock(album, w, block, folder); !drawn) return fail(drawn.error());
    if (auto drawn = drawMixed(album, w, folder); !drawn) return fail(drawn.error());
    return 0;
}
