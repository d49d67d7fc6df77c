// Importing mesh files: OBJ with MTL, PLY, STL, OFF, glTF 2.0 and GLB (reliability rules 1 to 3).
// Comes from the command line; the BlockSource goes to build/. Several files give several blocks; one file is split by
// its objects or groups, or on a ground grid when it is large.
// The caller runs this in a child process of its own when the file is not trusted.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "import/source_scene.h"

namespace fb {

enum class BlockSplit : std::uint8_t { automatic, none, grid, groups };

struct ImportOptions {
    std::optional<UpAxis> up;                     // default: read off the first file (guess_up.h), else z for STL, y
    BlockSplit split = BlockSplit::automatic;
    std::uint64_t trianglesPerBlock = 40000;      // aim of the ground grid
    std::optional<std::filesystem::path> texture; // for files with texture coordinates that name no texture
    std::string name;                             // default: the first file's stem
};

[[nodiscard]] Result<std::unique_ptr<BlockSource>> importFiles(std::span<const std::filesystem::path> files,
                                                              const ImportOptions& options, const Progress& progress);

// One file as it is, before clean-up and splitting: for tests and for drawing the source directly. Positions are the
// file's own numbers in double precision.
[[nodiscard]] Result<SourceBlock> readMeshFile(const std::filesystem::path& file, const ImportOptions& options,
                                               ImportReport& report);

// Welds vertices that are equal in every attribute, drops degenerate and duplicate triangles, refuses positions that
// are not finite and indices out of range. Adds missing normals (area weighted). Counts all of it in `report`.
[[nodiscard]] Result<void> cleanMesh(SourceMesh& mesh, const std::string& what, ImportReport& report);

// Splits triangles by the ground cell of their centroid; triangles stay whole. Blocks come in row order, empty ones
// are left out.
[[nodiscard]] std::vector<SourceBlock> splitOnGroundGrid(SourceBlock&& block, UpAxis up,
                                                         std::uint64_t trianglesPerBlock);

}  // namespace fb
