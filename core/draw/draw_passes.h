// The passes of a frame as OpenGL calls: nodes, sky, wireframe, boxes. In: ordered draws and the pools. Out:
// pixels in the picture that is bound, and counters.
#pragma once

#include "draw/frame_ring.h"
#include "draw/order_draws.h"
#include "draw/programs.h"

namespace fb {

struct PassInput {
    const DrawInput& draw;
    const DrawLists& lists;
    const MeshPages& meshes;
    const TexturePages& textures;
    const Programs& programs;
    unsigned emptyVertexArray;  // for passes whose vertices come from storage buffers or the vertex number
};

// Bytes of the frame ring that drawPasses() takes for this frame.
[[nodiscard]] std::uint64_t passBytes(const DrawInput& draw, const DrawLists& lists);

// One bit for each program that this frame uses.
[[nodiscard]] std::uint32_t usedPrograms(const DrawInput& draw, const DrawLists& lists);

// Sets the state that every pass relies on: the context may be shared with a GUI.
void beginPasses();
// Writes the frame's data into `ring` (begun with passBytes()) and draws; the picture is bound and cleared.
[[nodiscard]] DrawCounters drawPasses(const PassInput& input, FrameRing& ring);
// Gives the context back as it is at the start of a program, for whoever draws next.
void endPasses();

}  // namespace fb
