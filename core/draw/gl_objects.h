// Owners of OpenGL names: the object is deleted with its owner, while the context that made it is current.
// In: nothing but the kind. Out: an OpenGL 4.5 object made with direct state access.
#pragma once

#include <utility>

namespace fb {

template <class Kind>
class GlObject {
  public:
    GlObject() = default;
    // Whatever Kind::create needs: the target of a texture or query, the type of a shader.
    template <class... Arguments>
    [[nodiscard]] static GlObject make(Arguments... arguments) {
        GlObject object;
        object.name_ = Kind::create(arguments...);
        return object;
    }
    ~GlObject() { reset(); }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        if (this != &other) {
            reset();
            name_ = std::exchange(other.name_, 0u);
        }
        return *this;
    }

    [[nodiscard]] unsigned name() const { return name_; }
    [[nodiscard]] explicit operator bool() const { return name_ != 0; }
    void reset() {
        if (name_ != 0) Kind::destroy(std::exchange(name_, 0u));
    }

  private:
    unsigned name_ = 0;
};

struct GlBufferKind {
    static unsigned create();
    static void destroy(unsigned name);
};
struct GlTextureKind {
    static unsigned create(unsigned target);
    static void destroy(unsigned name);
};
struct GlSamplerKind {
    static unsigned create();
    static void destroy(unsigned name);
};
struct GlVertexArrayKind {
    static unsigned create();
    static void destroy(unsigned name);
};
struct GlFramebufferKind {
    static unsigned create();
    static void destroy(unsigned name);
};
struct GlQueryKind {
    static unsigned create(unsigned target);
    static void destroy(unsigned name);
};
struct GlShaderKind {
    static unsigned create(unsigned type);
    static void destroy(unsigned name);
};
struct GlProgramKind {
    static unsigned create();
    static void destroy(unsigned name);
};

using GlBuffer = GlObject<GlBufferKind>;
using GlTexture = GlObject<GlTextureKind>;
using GlSampler = GlObject<GlSamplerKind>;
using GlVertexArray = GlObject<GlVertexArrayKind>;
using GlFramebuffer = GlObject<GlFramebufferKind>;
using GlQuery = GlObject<GlQueryKind>;
using GlShader = GlObject<GlShaderKind>;
using GlProgram = GlObject<GlProgramKind>;

}  // namespace fb
