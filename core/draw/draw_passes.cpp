#include "draw/draw_passes.h"

#include <epoxy/gl.h>

#include "draw/frame_data.h"

namespace fb {

namespace {

// As OpenGL defines them for glMultiDraw*Indirect.
struct ElementsCommand {
    std::uint32_t count, instanceCount, firstIndex, baseVertex, baseInstance;
};
struct ArraysCommand {
    std::uint32_t count, instanceCount, first, baseInstance;
};
static_assert(sizeof(ElementsCommand) == 20 && sizeof(ArraysCommand) == 16);

constexpr std::uint32_t kBoxVertices = 24;

const void* asPointer(std::uint64_t offset) {
    return reinterpret_cast<const void*>(offset);
}

template <class T>
void bindPlace(unsigned target, std::uint32_t binding, const FrameRing& ring,
               const FrameRing::Place<T>& place) {
    glBindBufferRange(target, binding, ring.buffer(), static_cast<GLintptr>(place.offsetBytes),
                      static_cast<GLsizeiptr>(place.sizeBytes()));
}

void writeDraws(const DrawInput& input, const DrawLists& lists, std::span<gpu::DrawData> data) {
    for (std::size_t i = 0; i < lists.draws.size(); ++i) {
        const Draw& draw = lists.draws[i];
        const Hierarchy& h = input.hierarchy;
        const SplitTranslation split =
            splitTranslation(h.grids[h.block[draw.node]].origin, input.view.camera.eye);
        data[i] = {split.coarse, draw.layer, split.fine, draw.baseVertex, levelColour(h.level[draw.node]), 0};
    }
}

void drawNodes(const PassInput& input, FrameRing& ring, DrawCounters& counters) {
    const auto commands = ring.take<ElementsCommand>(input.lists.draws.size());
    for (std::size_t i = 0; i < input.lists.draws.size(); ++i) {
        const Draw& draw = input.lists.draws[i];
        commands.items[i] = {draw.indexCount, 1, draw.firstIndex, draw.baseVertex,
                             static_cast<std::uint32_t>(i)};
    }
    glBindSampler(0, input.textures.sampler());
    std::uint32_t variant = kVariants, texturePage = kNoPage, meshPage = kNoPage;
    for (const Batch& batch : input.lists.batches) {
        if (batch.variant != variant) {
            glUseProgram(input.programs.nodes[batch.variant].name());
            ++counters.stateChanges;
        }
        if (batch.texturePage != texturePage && batch.texturePage != kNoPage) {
            glBindTextureUnit(0, input.textures.texture(batch.texturePage));
            ++counters.stateChanges;
        }
        if (batch.meshPage != meshPage) {
            glBindVertexArray(input.meshes.vertexArray(batch.meshPage));
            ++counters.stateChanges;
        }
        variant = batch.variant;
        texturePage = batch.texturePage;
        meshPage = batch.meshPage;
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                    asPointer(commands.offsetBytes + batch.first * sizeof(ElementsCommand)),
                                    static_cast<GLsizei>(batch.count), 0);
        ++counters.multiDraws;
        counters.draws += batch.count;
        if ((batch.variant & kTextured) != 0) counters.texturedDraws += batch.count;
        if ((batch.variant & kLit) != 0) counters.litDraws += batch.count;
    }
}

// Only pixels that nothing covers have depth 0.
void drawSky(const PassInput& input, DrawCounters& counters) {
    glBindVertexArray(input.emptyVertexArray);
    glUseProgram(input.programs.sky.name());
    glDepthFunc(GL_EQUAL);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    counters.stateChanges += 2;
    ++counters.draws;
}

void drawWireframe(const PassInput& input, FrameRing& ring, DrawCounters& counters) {
    const auto commands = ring.take<ArraysCommand>(input.lists.draws.size());
    for (std::size_t i = 0; i < input.lists.draws.size(); ++i) {
        const Draw& draw = input.lists.draws[i];
        commands.items[i] = {draw.indexCount, 1, draw.firstIndex, static_cast<std::uint32_t>(i)};
    }
    GLint64 mostBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &mostBytes);
    glBindVertexArray(input.emptyVertexArray);
    glUseProgram(input.programs.wire.name());
    counters.stateChanges += 2;
    glDepthFunc(GL_GEQUAL);
    glEnable(GL_BLEND);
    // The picture stays opaque: the GUI blends it over its window.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    std::uint32_t meshPage = kNoPage;
    for (const Batch& batch : input.lists.batches) {
        // A page of one enormous mesh may be more than a shader can read: its edges are left out.
        if (static_cast<GLint64>(input.meshes.pageBytes(batch.meshPage)) > mostBytes) continue;
        if (batch.meshPage != meshPage) {
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, gpu::kMeshBinding,
                             input.meshes.buffer(batch.meshPage));
            ++counters.stateChanges;
        }
        meshPage = batch.meshPage;
        glMultiDrawArraysIndirect(GL_TRIANGLES,
                                  asPointer(commands.offsetBytes + batch.first * sizeof(ArraysCommand)),
                                  static_cast<GLsizei>(batch.count), 0);
        ++counters.multiDraws;
        counters.draws += batch.count;
    }
    glDisable(GL_BLEND);
}

void drawBoxes(const PassInput& input, FrameRing& ring, DrawCounters& counters) {
    const auto boxes = ring.take<gpu::BoxData>(input.lists.nodes.size());
    const glm::dvec3& eye = input.draw.view.camera.eye;
    const Hierarchy& h = input.draw.hierarchy;
    for (std::size_t i = 0; i < input.lists.nodes.size(); ++i) {
        const NodeId node = input.lists.nodes[i];
        boxes.items[i] = {glm::vec3(glm::dvec3(h.bounds[node].min) - eye),
                          0.0f,
                          glm::vec3(glm::dvec3(h.bounds[node].max) - eye),
                          0.0f,
                          levelColour(h.level[node]),
                          0.0f};
    }
    bindPlace(GL_SHADER_STORAGE_BUFFER, gpu::kBoxBinding, ring, boxes);
    glBindVertexArray(input.emptyVertexArray);
    glUseProgram(input.programs.boxes.name());
    glDepthFunc(GL_GEQUAL);
    glDrawArraysInstanced(GL_LINES, 0, kBoxVertices, static_cast<GLsizei>(boxes.items.size()));
    counters.stateChanges += 3;
    ++counters.draws;
}

}  // namespace

std::uint64_t passBytes(const DrawInput& draw, const DrawLists& lists) {
    const std::size_t draws = lists.draws.size();
    std::uint64_t bytes = FrameRing::roomFor(1, sizeof(gpu::FrameData));
    bytes +=
        FrameRing::roomFor(draws, sizeof(gpu::DrawData)) + FrameRing::roomFor(draws, sizeof(ElementsCommand));
    if (draw.settings.wireframe) bytes += FrameRing::roomFor(draws, sizeof(ArraysCommand));
    if (draw.settings.boxes) bytes += FrameRing::roomFor(lists.nodes.size(), sizeof(gpu::BoxData));
    return bytes;
}

std::uint32_t usedPrograms(const DrawInput& draw, const DrawLists& lists) {
    constexpr std::uint32_t kSky = 1u << kVariants, kWire = kSky << 1, kBoxes = kWire << 1;
    std::uint32_t used = kSky | (draw.settings.wireframe ? kWire : 0u) | (draw.settings.boxes ? kBoxes : 0u);
    for (const Batch& batch : lists.batches) used |= 1u << batch.variant;
    return used;
}

void beginPasses() {
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glFrontFace(GL_CCW);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

DrawCounters drawPasses(const PassInput& input, FrameRing& ring) {
    DrawCounters counters;
    counters.nodes = static_cast<std::uint32_t>(input.lists.nodes.size());
    counters.triangles = input.lists.triangles;
    const auto frame = ring.take<gpu::FrameData>(1);
    frame.items[0] = frameData(input.draw.view, input.draw.up);
    bindPlace(GL_UNIFORM_BUFFER, gpu::kFrameBinding, ring, frame);
    const bool anything = !input.lists.draws.empty();
    if (anything) {
        const auto data = ring.take<gpu::DrawData>(input.lists.draws.size());
        writeDraws(input.draw, input.lists, data.items);
        bindPlace(GL_SHADER_STORAGE_BUFFER, gpu::kDrawBinding, ring, data);
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, ring.buffer());
        drawNodes(input, ring, counters);
    }
    glDepthMask(GL_FALSE);
    drawSky(input, counters);
    if (input.draw.settings.wireframe && anything) drawWireframe(input, ring, counters);
    if (input.draw.settings.boxes && !input.lists.nodes.empty()) drawBoxes(input, ring, counters);
    glDepthMask(GL_TRUE);
    return counters;
}

void endPasses() {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindSampler(0, 0);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glDisable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

}  // namespace fb
