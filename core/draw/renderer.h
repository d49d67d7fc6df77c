// The renderer: draws a front with OpenGL 4.5 core, the same code on a window's context and on a surfaceless
// one. The caller makes the context current first and keeps it longer than the renderer. Nodes live in shared
// buffers and in texture arrays by size class, so a front is a few multi-draws. Positions are drawn relative
// to the camera (the subtraction is done in double), depth is reversed and infinite.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "effects/effects.h"
#include "import/source_scene.h"
#include "load/residency.h"
#include "scenefile/scene.h"
#include "select/view.h"
#include "settings/settings.h"

namespace fb {

struct DrawInput {
    const Hierarchy& hierarchy;
    std::span<const NodeId> front;
    const View& view;  // width and height are the picture's size in pixels
    const DrawSettings& settings;
    const ActiveEffects& effects;
    glm::vec3 up{0, 1, 0};  // for the sky and the light
};

struct DrawCounters {
    std::uint32_t nodes = 0, multiDraws = 0, draws = 0, stateChanges = 0;
    std::uint32_t texturedDraws = 0, litDraws = 0;  // of nodes, by programs with these effects
    std::uint64_t triangles = 0;
};

// The time that drawing took, for the frame it belongs to: timer queries arrive some frames late on a GPU; on
// a software rasteriser, whose queries are wrong, the frame is finished and the wall clock read (design
// section 11).
struct DrawTime {
    std::uint64_t frame = 0;
    double milliseconds = 0.0;
};

struct GpuMemory {
    std::uint64_t meshBytes = 0, textureBytes = 0;                    // of resident nodes
    std::uint64_t allocatedMeshBytes = 0, allocatedTextureBytes = 0;  // of the pools that hold them
};

// What is empty is chosen to suit the device. Pages are large on a GPU, for few draw calls, and smaller on a
// software rasteriser, which gains nothing by that and clears each page as it makes it (16 MiB: 7 ms within
// one upload).
struct RendererOptions {
    std::optional<std::uint64_t> meshPageBytes;            // 8 MiB, software 2 MiB
    std::optional<std::uint64_t> largestTexturePageBytes;  // 16 MiB, software 4 MiB
    std::uint64_t smallestTexturePageBytes = 1 << 20;
    std::optional<std::size_t> uploadRingBytes;  // 32 MiB, software 0: straight from the caller's memory
    std::optional<bool> wallClock;               // software true; false: timer queries
};

class Renderer : public NodeDevice {
  public:
    // Errors: the context is older than 4.5, a shader does not compile (file and line).
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(const std::filesystem::path& shaderFolder,
                                                                  const RendererOptions& options = {});

    // "llvmpipe (LLVM 15.0.6, 256 bits), wall clock" or "NVIDIA …, timer queries".
    [[nodiscard]] virtual std::string deviceName() const = 0;
    [[nodiscard]] virtual bool softwareRasteriser() const = 0;

    // Draws into the renderer's own picture of the view's size, and starts measuring the time of `frame`.
    // Nodes of the front that are not resident are left out. Where the GPU has no memory for the picture or
    // the frame's data, the picture stays as it was and fault() says so.
    virtual DrawCounters draw(const DrawInput& input, std::uint64_t frame) = 0;
    // Why the last draw() did not draw; empty when it did.
    [[nodiscard]] virtual const std::string& fault() const = 0;
    // The next measured time, oldest first; false when none has arrived.
    [[nodiscard]] virtual bool takeTime(DrawTime& time) = 0;
    // The picture drawn last as a GL texture name (for the GUI; another one after the size has changed; row 0
    // of its texels is the bottom one), and as pixels (RGB, row 0 at the top). Values are sRGB bytes. No
    // texture before the first draw().
    [[nodiscard]] virtual unsigned pictureTexture() const = 0;
    [[nodiscard]] virtual Image readPicture() = 0;
    [[nodiscard]] virtual GpuMemory memory() const = 0;
};

// The colour of each level in ColourMode::level; colour-blind safe (Okabe and Ito 2008), repeats after 7.
[[nodiscard]] glm::vec3 levelColour(int level);

}  // namespace fb
