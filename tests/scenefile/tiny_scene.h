// Hand-made nodes and scenes for the tests of this stage, and a folder that goes away with the test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scenefile/scene.h"
#include "worlds/scratch_folder.h"

namespace fb::test {

class TemporaryFolder : public ScratchFolder {
  public:
    TemporaryFolder();
};

using Bytes = std::vector<std::uint8_t>;

[[nodiscard]] Bytes readAll(const std::filesystem::path& path);
void overwrite(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// An image of random texels as PNG or JPEG.
[[nodiscard]] NodeTexture makeTexture(PayloadCodec codec, std::uint16_t width, std::uint16_t height,
                                      std::uint8_t channels, std::uint64_t seed);
[[nodiscard]] NodeTexture makeTexture(PayloadCodec codec, std::uint16_t width, std::uint16_t height,
                                      std::uint8_t channels, const Bytes& pixels);

// One triangle with its right angle at `at`, legs of 4 cells along x and y; textured when `texture` is there.
[[nodiscard]] NodeData oneTriangle(std::uint32_t at, NodeTexture texture = {});

// A block under construction: its nodes' records are made from their content, as build/ would.
struct TinyBlock {
    BlockGrid grid{{0.0, 0.0, 0.0}, 0.25};
    struct Node {
        NodeData data;
        std::uint32_t parent = 0;
        std::uint32_t children = 0;
        std::uint8_t level = 0;
    };
    std::vector<Node> nodes;  // breadth first
};

// A root of one triangle; with `children` of one triangle each.
[[nodiscard]] TinyBlock tinyBlock(std::uint32_t children, NodeTexture texture = {});

inline constexpr std::uint64_t kSettingsHash = 0x1111'2222'3333'4444;
inline constexpr std::uint64_t kBlockHash = 0x5555'6666'7777'8888;

// Writes the pack of one block.
[[nodiscard]] BuiltBlock writePack(const std::filesystem::path& folder, std::uint32_t number,
                                   const TinyBlock& block);
[[nodiscard]] SceneInfo tinyInfo();
// Packs 0, 1, … and the scene. Returns what was written.
std::vector<BuiltBlock> writeTinyScene(const std::filesystem::path& folder,
                                       const std::vector<TinyBlock>& blocks);

// The error's line, or "no error".
template <class T>
[[nodiscard]] std::string lineOf(const Result<T>& result) {
    return result ? "no error" : result.error().oneLine();
}
[[nodiscard]] inline bool says(const std::string& line, const std::string& part) {
    return line.find(part) != std::string::npos;
}

// The faults that checkScene() finds, or the error that stops it.
[[nodiscard]] std::vector<std::string> faultsOf(const std::filesystem::path& folder);
// The only fault, or "N faults".
[[nodiscard]] std::string soleFault(const std::filesystem::path& folder);

}  // namespace fb::test
