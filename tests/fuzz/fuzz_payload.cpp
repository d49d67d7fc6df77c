// parsePayload() and decodeNode() on any bytes: no crash, and what is accepted keeps its own rules. Corpus:
// none is needed, since the first bytes are set to the magic and version so that the parser is reached.
// Images above a million texels are not decoded: they would only measure the image libraries' speed.
#include <cstdlib>
#include <cstring>

#include "scenefile/payload_format.h"
#include "scenefile/scene.h"

// OpenImageIO 2.4 leaks the 31 bytes of its message when a PNG ends too early (libpng jumps over their
// destructor).
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:ImageInput::geterror\n";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint8_t> bytes(data, data + size);
    if (size >= 8) {
        std::memcpy(bytes.data(), fb::kPayloadMagic.data(), 4);
        std::memcpy(bytes.data() + 4, &fb::kPayloadVersion, 4);
    }
    const fb::Result<fb::NodeData> node = fb::parsePayload(bytes, "fuzz");
    if (!node) return 0;
    for (std::uint32_t index : node->mesh.indices) {
        if (index >= node->mesh.vertices.size()) std::abort();
    }
    if (fb::mippedBytes(node->texture.width, node->texture.height) > (4u << 20)) return 0;
    const fb::Result<fb::DecodedNode> decoded = fb::decodeNode(*node, fb::BlockGrid{}, "fuzz");
    if (!decoded) return 0;
    const std::uint64_t expected =
        fb::residentBytes(static_cast<std::uint32_t>(node->mesh.vertices.size()),
                          node->mesh.texturedTriangles + node->mesh.untexturedTriangles, node->texture.width,
                          node->texture.height);
    if (decoded->sizeBytes() != expected) std::abort();
    if (fb::parsePayload(fb::encodePayload(*node).value(), "again")->mesh.vertices.size() !=
        node->mesh.vertices.size()) {
        std::abort();
    }
    return 0;
}
