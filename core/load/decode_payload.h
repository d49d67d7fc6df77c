// From a payload's bytes to content that can be uploaded: checksum, parser, decoder, and the size that the
// hierarchy promises (the memory budget counts on it). Any thread. What comes next: upload on the main
// thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "load/payload_source.h"
#include "scenefile/scene.h"

namespace fb {

// "node 7", for errors.
[[nodiscard]] std::string nodePlace(NodeId node);

// Bytes whose checksum is wrong are never parsed. Running out of memory is an error like any other.
[[nodiscard]] Result<std::unique_ptr<DecodedNode>> decodePayload(const Scene& scene, NodeId node,
                                                                 std::span<const std::uint8_t> bytes);

// The whole payload at once.
[[nodiscard]] Result<std::vector<std::uint8_t>> readPayloadFrom(const Scene& scene, PayloadSource& source, NodeId node);
// Read and decoded.
[[nodiscard]] Result<std::unique_ptr<DecodedNode>> readAndDecode(const Scene& scene, PayloadSource& source,
                                                                 NodeId node);

}  // namespace fb
