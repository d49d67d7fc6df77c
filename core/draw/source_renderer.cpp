#include "draw/source_renderer.h"

#include <epoxy/gl.h>

#include <array>
#include <bit>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "draw/compile_shaders.h"
#include "draw/draw_passes.h"
#include "draw/frame_data.h"
#include "draw/gl_messages.h"
#include "draw/gl_objects.h"
#include "draw/picture.h"

namespace fb {

namespace {

struct Corner {
    glm::vec3 relative, normal;
    glm::vec2 uv;
    glm::vec3 colour;
};

glm::dvec3 faceNormal(const SourceMesh& mesh, const glm::uvec3& t) {
    return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
}

std::vector<glm::vec3> normalsOf(const SourceMesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangles) {
        for (int c = 0; c < 3; ++c) sums[t[c]] += faceNormal(mesh, t);
    }
    std::vector<glm::vec3> normals(mesh.positions.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const bool known = mesh.hasNormals() && mesh.normals[i] != glm::vec3(0.0f);
        const double length = glm::length(sums[i]);
        normals[i] = known          ? mesh.normals[i]
                     : length > 0.0 ? glm::vec3(sums[i] / length)
                                    : glm::vec3(0, 0, 1);
    }
    return normals;
}

Result<GlTexture> uploadTexture(const SourceTexture& source) {
    auto image = loadTexture(source);
    if (!image) return passOn(image);
    const auto pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
    const auto channels = static_cast<std::size_t>(image->channels);
    std::vector<std::uint8_t> rgba(pixels * 4);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* from = image->pixels.data() + i * channels;
        const bool grey = channels < 3;
        rgba[i * 4] = from[0];
        rgba[i * 4 + 1] = grey ? from[0] : from[1];
        rgba[i * 4 + 2] = grey ? from[0] : from[2];
        rgba[i * 4 + 3] = channels == 4 ? from[3] : channels == 2 ? from[1] : std::uint8_t{255};
    }
    GlTexture texture = GlTexture::make(unsigned{GL_TEXTURE_2D});
    const unsigned name = texture.name();
    const auto longest = static_cast<unsigned>(std::max(image->width, image->height));
    clearGlErrors();
    glTextureStorage2D(name, std::bit_width(longest), GL_RGBA8, image->width, image->height);
    if (auto made = takeGlError("making the texture " + source.name); !made) return passOn(made);
    glTextureSubImage2D(name, 0, 0, 0, image->width, image->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glGenerateTextureMipmap(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return texture;
}

Result<void> checkBlock(const SourceBlock& block) {
    const SourceMesh& mesh = block.mesh;
    const std::size_t vertices = mesh.positions.size();
    for (const std::size_t count : {mesh.normals.size(), mesh.uvs.size(), mesh.colours.size()}) {
        if (count != 0 && count != vertices)
            return failure(block.name, "", "attributes for some vertices only");
    }
    if (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()) {
        return failure(block.name, "", "materials for some triangles only");
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        if (t.x < vertices && t.y < vertices && t.z < vertices) continue;
        return failure(block.name, "triangle " + std::to_string(i), "a vertex that does not exist");
    }
    return {};
}

// One draw: all triangles of one material in one block.
class SourceDrawer {
  public:
    SourceDrawer(std::filesystem::path shaderFolder, const View& view, const ActiveEffects& effects)
        : shaderFolder_(std::move(shaderFolder)), eye_(view.camera.eye), effects_(effects) {}

    [[nodiscard]] Result<void> draw(const SourceBlock& block) {
        if (auto usable = checkBlock(block); !usable) return usable;
        const std::vector<glm::vec3> normals = normalsOf(block.mesh);
        std::map<std::uint32_t, std::vector<Corner>> byMaterial;
        for (std::size_t i = 0; i < block.mesh.triangles.size(); ++i) {
            const std::uint32_t number = block.mesh.materials.empty() ? kNoMaterial : block.mesh.materials[i];
            addTriangle(block, number, block.mesh.triangles[i], normals, byMaterial[number]);
        }
        for (const auto& [number, corners] : byMaterial) {
            if (auto drawn = drawMaterial(block, materialOf(block, number), corners); !drawn) return drawn;
        }
        return {};
    }

  private:
    [[nodiscard]] static const SourceMaterial* materialOf(const SourceBlock& block, std::uint32_t number) {
        return number < block.materials.size() ? &block.materials[number] : nullptr;
    }

    void addTriangle(const SourceBlock& block, std::uint32_t number, glm::uvec3 t,
                     const std::vector<glm::vec3>& normals, std::vector<Corner>& corners) const {
        const SourceMesh& mesh = block.mesh;
        const SourceMaterial* material = materialOf(block, number);
        // The light asks which side is seen: winding follows the normals.
        const glm::vec3 normal = normals[t.x] + normals[t.y] + normals[t.z];
        if (glm::dot(faceNormal(mesh, t), glm::dvec3(normal)) < 0.0) std::swap(t.y, t.z);
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t v = t[c];
            glm::vec3 colour(surfaceColour(material, mesh.hasColours()));
            if (mesh.hasColours()) colour *= glm::vec3(mesh.colours[v]) / 255.0f;
            corners.push_back({glm::vec3(mesh.positions[v] - eye_), normals[v],
                               mesh.hasUvs() ? mesh.uvs[v] : glm::vec2(0.0f), colour});
        }
    }

    [[nodiscard]] Result<void> drawMaterial(const SourceBlock& block, const SourceMaterial* material,
                                            const std::vector<Corner>& corners) {
        GlTexture texture;
        const bool textured = effects_[Effect::texturing] && material != nullptr && material->texture >= 0 &&
                              static_cast<std::size_t>(material->texture) < block.textures.size() &&
                              block.mesh.hasUvs();
        if (textured) {
            auto uploaded = uploadTexture(block.textures[static_cast<std::size_t>(material->texture)]);
            if (!uploaded) return passOn(uploaded);
            texture = std::move(*uploaded);
        }
        const std::uint32_t variant = (textured ? kTextured : 0u) | (effects_[Effect::lighting] ? kLit : 0u) |
                                      (textured && material->alphaMask ? kMask : 0u);
        if (auto compiled = useProgram(variant); !compiled) return compiled;
        const GlBuffer buffer = GlBuffer::make();
        clearGlErrors();
        glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(corners.size() * sizeof(Corner)),
                             corners.data(), 0);
        if (auto made = takeGlError("making the vertices of " + block.name); !made) return made;
        const GlVertexArray array = GlVertexArray::make();
        glVertexArrayVertexBuffer(array.name(), 0, buffer.name(), 0, sizeof(Corner));
        constexpr std::array<std::pair<int, std::size_t>, 4> kAttributes = {{{3, offsetof(Corner, relative)},
                                                                             {3, offsetof(Corner, normal)},
                                                                             {2, offsetof(Corner, uv)},
                                                                             {3, offsetof(Corner, colour)}}};
        for (unsigned i = 0; i < kAttributes.size(); ++i) {
            glVertexArrayAttribFormat(array.name(), i, kAttributes[i].first, GL_FLOAT, GL_FALSE,
                                      static_cast<GLuint>(kAttributes[i].second));
            glVertexArrayAttribBinding(array.name(), i, 0);
            glEnableVertexArrayAttrib(array.name(), i);
        }
        glBindVertexArray(array.name());
        glBindTextureUnit(0, texture.name());
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
        glBindTextureUnit(0, 0);
        return {};
    }

    [[nodiscard]] Result<void> useProgram(std::uint32_t variant) {
        if (!programs_[variant]) {
            std::vector<std::string_view> defines;
            if ((variant & kTextured) != 0) defines.push_back("TEXTURED");
            if ((variant & kLit) != 0) defines.push_back("LIT");
            if ((variant & kMask) != 0) defines.push_back("MASK");
            auto compiled = compileProgram(shaderFolder_, {"source.vert", "source.frag", defines});
            if (!compiled) return passOn(compiled);
            programs_[variant] = std::move(*compiled);
        }
        glUseProgram(programs_[variant].name());
        return {};
    }

    std::filesystem::path shaderFolder_;
    glm::dvec3 eye_;
    const ActiveEffects& effects_;
    std::array<GlProgram, kVariants> programs_;
};

}  // namespace

Result<Image> drawSource(const std::filesystem::path& shaderFolder, std::span<const SourceBlock> blocks,
                         const View& view, const ActiveEffects& effects, glm::vec3 up) {
    Picture picture;
    if (auto made = picture.resize(view.width, view.height); !made) return passOn(made);
    auto sky = compileProgram(shaderFolder, {"sky.vert", "sky.frag", {}});
    if (!sky) return passOn(sky);
    const gpu::FrameData frame = frameData(view, up);
    const GlBuffer frameBuffer = GlBuffer::make();
    glNamedBufferStorage(frameBuffer.name(), sizeof(frame), &frame, 0);

    beginPasses();
    picture.beginDrawing();
    glBindBufferBase(GL_UNIFORM_BUFFER, gpu::kFrameBinding, frameBuffer.name());
    SourceDrawer drawer(shaderFolder, view, effects);
    Result<void> drawn;
    for (const SourceBlock& block : blocks) {
        drawn = drawer.draw(block);
        if (!drawn) break;
    }
    if (drawn) {
        const GlVertexArray noAttributes = GlVertexArray::make();
        glBindVertexArray(noAttributes.name());
        glUseProgram(sky->name());
        glDepthFunc(GL_EQUAL);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    endPasses();
    if (!drawn) return passOn(drawn);
    return picture.read();
}

}  // namespace fb
