// A scene on disk (design section 5): NAME.fbscene/ with scene.toml, hierarchy.bin and blocks/NNNNN.pack.
// openScene() reads and verifies all but the payloads; readPayload() reads one of those;
// PackWriter and writeScene() make a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "import/source_scene.h"
#include "scenefile/hierarchy.h"
#include "scenefile/node_data.h"

namespace fb {

inline constexpr std::uint32_t kSceneFormatVersion = 4;

struct SceneInfo {
    std::string name;
    std::string program;      // "frontbench 0.1.0"
    glm::dvec3 origin{0.0};   // source coordinates = origin + coordinates in the scene
    UpAxis up = UpAxis::y;
    Box3d bounds;             // relative to the origin
    std::uint64_t sourceTriangles = 0;  // after clean-up, before cutting
    double sourceAreaSquareMetres = 0.0;
    std::uint64_t sourceHash = 0, buildSettingsHash = 0;
    std::uint64_t desiredTriangles = 0, levelFactor = 0;  // c_desiredTris and c_levelFactor as built
    std::vector<std::string> sourceFiles;
    std::vector<std::string> reportLines;  // what the import dropped or repaired
    std::vector<WalkHint> walks;

    [[nodiscard]] glm::dvec3 upVector() const { return up == UpAxis::y ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1); }
};

struct Scene {
    std::filesystem::path folder;
    SceneInfo info;
    Hierarchy hierarchy;
    std::uint64_t sceneHash = 0;  // checksum of hierarchy.bin: names this scene in reports
    std::vector<FileReader> packs;  // by PayloadRef::pack; numbers that no block has are not open
};

[[nodiscard]] Result<Scene> openScene(const std::filesystem::path& folder);

// The payload's bytes, verified against the checksum in the hierarchy. For the loader, which reads in chunks, see
// load/; this reads all at once.
[[nodiscard]] Result<std::vector<std::uint8_t>> readPayload(const Scene& scene, NodeId node);

// --- Payload coding: mesh with meshoptimizer's codecs, texture as JPEG or PNG. ---
[[nodiscard]] Result<std::vector<std::uint8_t>> encodePayload(const NodeData& node);
// Every count is checked against the bytes left; `what` names the payload in the error. Vertices and triangles come back
// in another order (textured triangles still first) and triangles may begin with another corner.
[[nodiscard]] Result<NodeData> parsePayload(std::span<const std::uint8_t> bytes, const std::string& what);
// Turns it into what the renderer uploads: float positions, texture decoded, mip levels by a 2x2 box filter.
[[nodiscard]] Result<DecodedNode> decodeNode(const NodeData& node, const BlockGrid& grid, const std::string& what);

// --- Writing. One pack per block, in any order and from any thread; then the scene. ---
// checkScene() holds these records against the payloads: the bounds contain every triangle's corners as the grid gives
// them (grid.origin + step * coordinate, rounded to float), the area is that of the payload's triangles.
struct BuiltNode {
    std::uint32_t parentInBlock = 0;  // index within the block, root: 0 is its own parent
    std::uint32_t childCount = 0;
    std::uint8_t level = 0;
    bool stuck = false;  // has many more triangles than it should
    Box3f bounds;
    std::uint32_t texturedTriangles = 0, untexturedTriangles = 0, skirtTriangles = 0, vertices = 0;
    float staticBenefit = 0, normalCoherence = 0, areaSquareMetres = 0, geometricErrorMetres = 0;
    float borderErrorMetres = 0;
    glm::vec3 averageNormal{0.0f};
    std::uint16_t textureWidth = 0, textureHeight = 0;
    PayloadRef payload;
};

// A finished block: its nodes breadth first (node 0 the root, children contiguous) and the payload refs into its pack.
struct BuiltBlock {
    BlockGrid grid;
    BlockKind kind = BlockKind::objects;
    std::uint64_t sourceTriangles = 0;  // before cutting
    double sourceAreaSquareMetres = 0.0;
    std::vector<BuiltNode> nodes;
};

class PackWriter {
  public:
    [[nodiscard]] static Result<PackWriter> create(const std::filesystem::path& sceneFolder, std::uint32_t block);
    // Appends one payload; nodes come in breadth-first order.
    [[nodiscard]] Result<PayloadRef> append(std::span<const std::uint8_t> payload);
    // Seals the pack with the block's node records, so that a killed build can take it up again.
    [[nodiscard]] Result<void> finish(const BuiltBlock& block, std::uint64_t settingsHash, std::uint64_t blockHash);

  private:
    AtomicFile file_;
    std::uint32_t block_ = 0;
};

// The block that an earlier, killed build finished with the same settings and source, or nothing.
[[nodiscard]] std::optional<BuiltBlock> reusePack(const std::filesystem::path& sceneFolder, std::uint32_t block,
                                                  std::uint64_t settingsHash, std::uint64_t blockHash);
// The same of a pack that is known to be of the right source and to have been written just now: payloads are not read.
[[nodiscard]] std::optional<BuiltBlock> takePack(const std::filesystem::path& sceneFolder, std::uint32_t block,
                                                 std::uint64_t settingsHash);

// Joins the blocks into one hierarchy and writes scene.toml, then hierarchy.bin: the scene is complete when
// hierarchy.bin has its name. The blocks' packs must be there, in ascending order; blocks without nodes are left out.
// Bounds and program are filled in where `info` has none.
[[nodiscard]] Result<void> writeScene(const std::filesystem::path& folder, const SceneInfo& info,
                                      const std::vector<BuiltBlock>& blocks);
[[nodiscard]] Hierarchy joinBlocks(const std::vector<BuiltBlock>& blocks);

// --- `frontbench check`: every payload read, verified, parsed and held against its record. ---
struct SceneCheck {
    std::uint64_t payloads = 0, bytes = 0;
    std::vector<std::string> faults;  // one line each: file, place, reason
};
[[nodiscard]] Result<SceneCheck> checkScene(const std::filesystem::path& folder, const Progress& progress);

}  // namespace fb
