#include "draw/gl_objects.h"

#include <epoxy/gl.h>

namespace fb {

unsigned GlBufferKind::create() {
    unsigned name = 0;
    glCreateBuffers(1, &name);
    return name;
}
void GlBufferKind::destroy(unsigned name) {
    glDeleteBuffers(1, &name);
}

unsigned GlTextureKind::create(unsigned target) {
    unsigned name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}
void GlTextureKind::destroy(unsigned name) {
    glDeleteTextures(1, &name);
}

unsigned GlSamplerKind::create() {
    unsigned name = 0;
    glCreateSamplers(1, &name);
    return name;
}
void GlSamplerKind::destroy(unsigned name) {
    glDeleteSamplers(1, &name);
}

unsigned GlVertexArrayKind::create() {
    unsigned name = 0;
    glCreateVertexArrays(1, &name);
    return name;
}
void GlVertexArrayKind::destroy(unsigned name) {
    glDeleteVertexArrays(1, &name);
}

unsigned GlFramebufferKind::create() {
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    return name;
}
void GlFramebufferKind::destroy(unsigned name) {
    glDeleteFramebuffers(1, &name);
}

unsigned GlQueryKind::create(unsigned target) {
    unsigned name = 0;
    glCreateQueries(target, 1, &name);
    return name;
}
void GlQueryKind::destroy(unsigned name) {
    glDeleteQueries(1, &name);
}

unsigned GlShaderKind::create(unsigned type) {
    return glCreateShader(type);
}
void GlShaderKind::destroy(unsigned name) {
    glDeleteShader(name);
}

unsigned GlProgramKind::create() {
    return glCreateProgram();
}
void GlProgramKind::destroy(unsigned name) {
    glDeleteProgram(name);
}

}  // namespace fb
