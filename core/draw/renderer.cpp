#include "draw/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "draw/check_node.h"
#include "draw/draw_passes.h"
#include "draw/gl_messages.h"
#include "draw/picture.h"
#include "draw/time_frames.h"

namespace fb {

namespace {

constexpr std::uint64_t kMeshPageBytes = 8 << 20, kSoftwareMeshPageBytes = 2 << 20;
constexpr std::uint64_t kTexturePageBytes = 16 << 20, kSoftwareTexturePageBytes = 4 << 20;
// Some frames' uploads at the default budget (load.upload_per_frame) fit at once.
constexpr std::size_t kUploadRingBytes = 32 << 20;

bool namesSoftware(std::string renderer) {
    static constexpr std::array<std::string_view, 7> kNames = {
        "llvmpipe",   "softpipe", "swiftshader", "swrast", "software rasterizer", "microsoft basic render",
        "gdi generic"};
    std::ranges::transform(renderer, renderer.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::any_of(
        kNames, [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

struct Device {
    std::string name;
    bool software = false;
};

Result<Device> askDevice() {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 45) {
        return failure("", "OpenGL",
                       "version " + std::to_string(version / 10) + "." + std::to_string(version % 10) +
                           " of the driver is older than 4.5",
                       "update the graphics driver, or run with LIBGL_ALWAYS_SOFTWARE=1");
    }
    if (!epoxy_has_gl_extension("GL_ARB_shader_draw_parameters")) {
        return failure("", "OpenGL", "the driver lacks GL_ARB_shader_draw_parameters",
                       "update the graphics driver, or run with LIBGL_ALWAYS_SOFTWARE=1");
    }
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    Device device;
    device.name = name == nullptr ? "unknown device" : name;
    device.software = namesSoftware(device.name);
    return device;
}

// Owns the GPU side of resident nodes. Members are ordered so that everything goes before the context, which
// the caller keeps longer.
class PooledRenderer final : public Renderer {
  public:
    PooledRenderer(Device device, bool wallClock, const RendererOptions& options, Programs programs,
                   UploadStaging staging)
        : device_(std::move(device)),
          wallClock_(wallClock),
          programs_(std::move(programs)),
          staging_(std::move(staging)),
          meshes_(options.meshPageBytes.value_or(device_.software ? kSoftwareMeshPageBytes : kMeshPageBytes)),
          textures_(options.smallestTexturePageBytes,
                    options.largestTexturePageBytes.value_or(device_.software ? kSoftwareTexturePageBytes
                                                                              : kTexturePageBytes),
                    !device_.software),
          timer_(wallClock),
          emptyVertexArray_(GlVertexArray::make()) {}

    [[nodiscard]] Result<void> upload(NodeId node, const DecodedNode& content) override {
        if (auto usable = checkNode(node, content); !usable) return usable;
        GpuNode made;
        made.resident = true;
        made.alphaMask = content.flags.alphaMask;
        made.texturedIndices = content.texturedTriangles * 3;
        made.untexturedIndices = content.untexturedTriangles * 3;
        made.textureBytes = content.texels.size();
        auto mesh = meshes_.allocate(content.vertices.size(), content.indices.size());
        if (!mesh) return atNode(node, mesh.error());
        made.mesh = *mesh;
        auto texture = textures_.allocate(content.textureWidth, content.textureHeight);
        if (!texture) {
            meshes_.release(made.mesh);
            return atNode(node, texture.error());
        }
        made.texture = *texture;
        clearGlErrors();
        meshes_.write(made.mesh, content, staging_);
        textures_.write(made.texture, content.texels, staging_);
        if (auto copied = takeGlError("copying a node"); !copied) {
            releaseSlots(made);
            return atNode(node, copied.error());
        }
        release(node);
        if (node >= nodes_.size())
            nodes_.resize(std::max<std::size_t>(node + std::size_t{1}, nodes_.size() * 2));
        nodes_[node] = made;
        meshBytes_ += made.mesh.sizeBytes();
        textureBytes_ += made.textureBytes;
        return {};
    }

    void release(NodeId node) override {
        if (node >= nodes_.size() || !nodes_[node].resident) return;
        meshBytes_ -= nodes_[node].mesh.sizeBytes();
        textureBytes_ -= nodes_[node].textureBytes;
        releaseSlots(nodes_[node]);
        nodes_[node] = {};
    }

    [[nodiscard]] std::string deviceName() const override {
        return device_.name + (wallClock_ ? ", wall clock" : ", timer queries");
    }
    [[nodiscard]] bool softwareRasteriser() const override { return device_.software; }
    [[nodiscard]] const std::string& fault() const override { return fault_; }

    DrawCounters draw(const DrawInput& input, std::uint64_t frame) override {
        fault_.clear();
        if (auto sized = picture_.resize(input.view.width, input.view.height); !sized)
            return refuse(sized.error());
        orderDraws(input, nodes_, lists_);
        // Drivers finish a program at its first use, which took 100 ms on llvmpipe: a frame with a program
        // that was never used is drawn twice and the second time measured, or the control would take it for
        // the scene's cost.
        const std::uint32_t used = usedPrograms(input, lists_);
        if ((used & ~warmPrograms_) != 0) {
            const DrawCounters unmeasured = drawOnce(input);
            if (!fault_.empty()) return unmeasured;
            warmPrograms_ |= used;
        }
        timer_.begin(frame);
        const DrawCounters counters = drawOnce(input);
        timer_.end();
        return counters;
    }

    [[nodiscard]] bool takeTime(DrawTime& time) override { return timer_.take(time); }
    [[nodiscard]] unsigned pictureTexture() const override { return picture_.texture(); }
    [[nodiscard]] Image readPicture() override { return picture_.read(); }

    [[nodiscard]] GpuMemory memory() const override {
        return {meshBytes_, textureBytes_, meshes_.allocatedBytes(), textures_.allocatedBytes()};
    }

  private:
    [[nodiscard]] static Result<void> atNode(NodeId node, Error error) {
        error.place = "node " + std::to_string(node);
        return tl::make_unexpected(std::move(error));
    }
    DrawCounters drawOnce(const DrawInput& input) {
        if (auto room = ring_.begin(passBytes(input, lists_)); !room) return refuse(room.error());
        beginPasses();
        picture_.beginDrawing();
        const PassInput pass{input, lists_, meshes_, textures_, programs_, emptyVertexArray_.name()};
        const DrawCounters counters = drawPasses(pass, ring_);
        ring_.end();
        endPasses();
        return counters;
    }
    DrawCounters refuse(const Error& error) {
        fault_ = error.oneLine();
        return {};
    }
    void releaseSlots(const GpuNode& node) {
        meshes_.release(node.mesh);
        textures_.release(node.texture);
    }

    Device device_;
    bool wallClock_;
    Programs programs_;
    UploadStaging staging_;
    MeshPages meshes_;
    TexturePages textures_;
    Picture picture_;
    FrameRing ring_;
    FrameTimer timer_;
    GlVertexArray emptyVertexArray_;
    std::vector<GpuNode> nodes_;  // by NodeId
    DrawLists lists_;             // scratch
    std::uint32_t warmPrograms_ = 0;
    std::uint64_t meshBytes_ = 0, textureBytes_ = 0;
    std::string fault_;
};

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const std::filesystem::path& shaderFolder,
                                                   const RendererOptions& options) {
    auto device = askDevice();
    if (!device) return passOn(device);
    auto programs = compilePrograms(shaderFolder);
    if (!programs) return passOn(programs);
    auto staging =
        UploadStaging::create(options.uploadRingBytes.value_or(device->software ? 0 : kUploadRingBytes));
    if (!staging) return passOn(staging);
    const bool wallClock = options.wallClock.value_or(device->software);
    return std::make_unique<PooledRenderer>(std::move(*device), wallClock, options, std::move(*programs),
                                            std::move(*staging));
}

}  // namespace fb
