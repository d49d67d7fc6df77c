#include "import/import_files.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "base/hash.h"
#include "import/clean_mesh.h"
#include "import/guess_up.h"
#include "import/hash_file.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/split_blocks.h"
#include "import/touching_borders.h"

namespace fb {
namespace {

// Part of the source hash: raise it when the same files give other blocks than before.
constexpr std::uint64_t kImportVersion = 2;

constexpr double kFarMetres = 10000.0, kFarDiagonals = 10.0;
constexpr std::size_t kMostGroups = 4096, kLeastMedianGroup = 500;

class BlocksInMemory final : public BlockSource {
  public:
    BlocksInMemory(SourceInfo info, std::vector<SourceBlock> blocks)
        : info_(std::move(info)), blocks_(std::move(blocks)) {}

    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return blocks_.size(); }
    [[nodiscard]] Result<SourceBlock> load(std::size_t block) const override {
        if (block < blocks_.size()) return blocks_[block];
        return failure(info_.name, "block " + std::to_string(block), "does not exist");
    }

  private:
    SourceInfo info_;
    std::vector<SourceBlock> blocks_;
};

// One file, clean, with the group of each triangle that was left.
struct CleanFile {
    SourceBlock block;
    std::vector<std::uint32_t> groups;
    std::vector<std::string> groupNames;
};

// Coordinates far from zero lose their last digits in 32 bits: they are kept relative to whole metres near
// the middle.
glm::dvec3 originOf(const Box3d& bounds) {
    const glm::dvec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double largest = std::max({farthest.x, farthest.y, farthest.z});
    const bool isFar = largest > kFarMetres || largest > kFarDiagonals * bounds.diagonal();
    return isFar ? glm::round(bounds.centre()) : glm::dvec3(0.0);
}

bool groupsMakeGoodBlocks(const CleanFile& file, std::uint64_t trianglesPerBlock) {
    std::vector<std::uint64_t> sizes(file.groupNames.size(), 0);
    for (const std::uint32_t group : file.groups) ++sizes[group];
    std::erase(sizes, 0u);
    if (sizes.size() < 2 || sizes.size() > kMostGroups) return false;
    std::sort(sizes.begin(), sizes.end());
    return sizes.back() <= 2 * trianglesPerBlock && sizes[sizes.size() / 2] > kLeastMedianGroup;
}

std::vector<SourceBlock> split(CleanFile&& file, bool isOnlyFile, UpAxis up, const ImportOptions& options) {
    const bool automatic = options.split == BlockSplit::automatic;
    const bool byGroups = options.split == BlockSplit::groups ||
                          (automatic && isOnlyFile && groupsMakeGoodBlocks(file, options.trianglesPerBlock));
    if (byGroups && !file.groups.empty()) {
        return splitByLabel(file.block, {file.groups, file.groupNames.size(), [&](std::size_t group) {
                                             const std::string& name = file.groupNames[group];
                                             return name.empty() ? file.block.name : name;
                                         }});
    }
    const bool isLarge = file.block.mesh.triangles.size() / 2 > options.trianglesPerBlock;
    if (options.split == BlockSplit::grid || (automatic && isLarge)) {
        return splitOnGroundGrid(std::move(file.block), up, options.trianglesPerBlock);
    }
    return {withoutUnused(file.block)};
}

class Import {
  public:
    Import(std::span<const std::filesystem::path> files, const ImportOptions& options,
           const Progress& progress)
        : files_(files), options_(options), progress_(progress) {}

    Result<std::unique_ptr<BlockSource>> run() {
        hasher_.number(kImportVersion).number(options_.trianglesPerBlock);
        hasher_.number(static_cast<std::uint64_t>(options_.split));
        for (std::size_t f = 0; f < files_.size(); ++f) {
            if (!goesOn("reading", f)) return stopped();
            if (Result<void> read = readFile(files_[f]); !read) return passOn(read);
        }
        hasher_.number(static_cast<std::uint64_t>(info_.up));
        info_.name = options_.name.empty() ? files_.front().stem().string() : options_.name;
        info_.origin = originOf(bounds_);
        info_.bounds = {bounds_.min - info_.origin, bounds_.max - info_.origin};
        std::vector<SourceBlock> blocks;
        for (std::size_t f = 0; f < cleaned_.size(); ++f) {
            if (!goesOn("splitting", f)) return stopped();
            for (glm::dvec3& p : cleaned_[f].block.mesh.positions) p -= info_.origin;
            for (SourceBlock& block : split(std::move(cleaned_[f]), files_.size() == 1, info_.up, options_)) {
                blocks.push_back(std::move(block));
            }
            cleaned_[f] = {};
            if (blocks.size() > kMaxBlocks) {
                return failure(files_[f].string(), {},
                               "gives more than " + std::to_string(kMaxBlocks) + " blocks",
                               "choose larger blocks");
            }
        }
        markSharedVertices(blocks);
        markTouchingBorders(blocks);
        if (!goesOn("splitting", cleaned_.size())) return stopped();
        info_.sourceHash = hasher_.digest();
        return std::make_unique<BlocksInMemory>(std::move(info_), std::move(blocks));
    }

  private:
    [[nodiscard]] bool goesOn(std::string_view phase, std::size_t done) const {
        return !progress_ || progress_(phase, static_cast<double>(done) / static_cast<double>(files_.size()));
    }
    [[nodiscard]] static tl::unexpected<Error> stopped() { return failure({}, {}, "the import was stopped"); }

    Result<void> readFile(const std::filesystem::path& path) {
        ImportReport report;
        Result<LoadedMesh> loaded = loadMesh(path, options_, report);
        if (!loaded) return passOn(loaded);
        hasher_.number(static_cast<std::uint64_t>(loaded->format)).number(loaded->contentHash);
        info_.files.push_back(path);
        for (const std::filesystem::path& other : loaded->mesh.otherFiles) {
            Result<std::uint64_t> hash = hashFile(other);
            if (!hash) return passOn(hash);
            hasher_.number(*hash);
            info_.files.push_back(other);
        }

        CleanFile file{std::move(loaded->mesh.block), {}, std::move(loaded->mesh.groupNames)};
        file.block.name = path.stem().string();
        std::vector<std::uint32_t> kept;
        if (Result<void> cleaned = cleanMesh(file.block.mesh, path.string(), report, kept); !cleaned)
            return cleaned;
        if (kept.empty()) return failure(path.string(), {}, "has no triangle with an area");
        if (!loaded->mesh.groups.empty()) {
            for (const std::uint32_t triangle : kept) file.groups.push_back(loaded->mesh.groups[triangle]);
        }
        chooseUp(loaded->format, path, file.block.mesh);
        for (const glm::dvec3& p : file.block.mesh.positions) bounds_.grow(p);
        info_.report.add(report);
        cleaned_.push_back(std::move(file));
        return {};
    }

    // One scene has one up axis: the option's, or the first file's: as its format says (glTF), as its surface shows,
    // or as is usual for its format.
    void chooseUp(MeshFormat format, const std::filesystem::path& path, const SourceMesh& mesh) {
        const UpAxis usual = format == MeshFormat::stl ? UpAxis::z : UpAxis::y;
        const std::string name = path.filename().string();
        if (options_.up) {
            info_.up = *options_.up;
        } else if (!cleaned_.empty()) {
            if (usual == usualUp_) return;
            info_.report.warnings.push_back(name + " usually has another axis upward than " +
                                            files_.front().filename().string() + ": nothing is turned");
        } else {
            usualUp_ = info_.up = usual;
            if (format == MeshFormat::gltf || format == MeshFormat::glb) return;
            const std::optional<UpGuess> guess = guessUp(mesh);
            if (!guess || guess->up == usual) return;
            info_.up = guess->up;
            const bool isZ = info_.up == UpAxis::z;
            info_.report.warnings.push_back(name + ": " + (isZ ? "z" : "y") + " is taken as up, because " +
                                            std::string(guess->reason) + " (--up " + (isZ ? "y" : "z") +
                                            " for the other)");
        }
    }

    std::span<const std::filesystem::path> files_;
    const ImportOptions& options_;
    const Progress& progress_;
    Hasher hasher_;
    SourceInfo info_;
    UpAxis usualUp_ = UpAxis::y;  // for the first file's format
    Box3d bounds_;
    std::vector<CleanFile> cleaned_;
};

}  // namespace

Result<std::unique_ptr<BlockSource>> importFiles(std::span<const std::filesystem::path> files,
                                                 const ImportOptions& options, const Progress& progress) {
    if (files.empty()) return usageFailure("INPUT", "no file to import is given");
    if (options.trianglesPerBlock == 0) return usageFailure("triangles per block", "must be at least 1");
    try {
        return Import(files, options, progress).run();
    } catch (const std::bad_alloc&) {
        return failure(files.front().string(), {}, "needs more memory than there is",
                       "import fewer or smaller files");
    }
}

}  // namespace fb
