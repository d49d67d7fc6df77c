#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "build/build_scene.h"
#include "build/check_block.h"
#include "build/finish_node.h"
#include "build/make_atlas.h"
#include "build/measure_error.h"
#include "build/quantise_block.h"
#include "build/split_mesh.h"

namespace fb {
namespace {

// Above this many texels in a block, automatic coding takes JPEG even for textures from lossless files.
constexpr std::uint64_t kLosslessTexels = 4'000'000;

class BlockBuilder {
  public:
    BlockBuilder(const SourceBlock& source, const BuildSettings& settings, TextureStore& store)
        : source_(source), settings_(settings), store_(store) {}

    Result<BlockBuild> run() {
        if (Result<void> sound = checkBlock(source_); !sound) return passOn(sound);
        textures_ = decodeTextures(source_, store_);
        QuantisedBlock quantised = quantiseBlock(source_, textures_);
        reportSource(quantised);
        mesh_ = std::move(quantised.mesh);
        Level level;
        level.triangles = std::move(quantised.triangles);
        if (level.triangles.empty()) {
            warn("block " + source_.name + " has no triangles and is left out");
            return std::move(result_);
        }
        result_.block.grid = mesh_.grid;
        level.pieces.push_back({0, 0, static_cast<std::uint32_t>(level.triangles.size())});
        if (Result<void> built = buildLevels(std::move(level)); !built) return passOn(built);
        growParents();
        reportResult();
        return std::move(result_);
    }

  private:
    void warn(std::string line) { result_.report.warnings.push_back(std::move(line)); }

    void reportSource(const QuantisedBlock& quantised) {
        result_.report.blocks = 1;
        result_.report.sourceTriangles = source_.mesh.triangles.size();
        result_.report.sourceAreaSquareMetres = quantised.sourceAreaSquareMetres;
        for (std::string& line : textures_.warnings) warn(std::move(line));
        if (quantised.unusableUvs > 0) {
            warn("block " + source_.name + ": " + std::to_string(quantised.unusableUvs) +
                 " triangles with absurd texture coordinates are drawn in their base colour");
        }
    }

    // Level by level, from the root to the leaves: a level is simplified before it is cut for the next, so
    // that only the planes that made it are locked.
    Result<void> buildLevels(Level level) {
        const auto triangles = static_cast<double>(level.triangles.size());
        const auto desired = static_cast<double>(settings_.desiredTriangles);
        double factor = triangles / desired;
        std::uint32_t firstOfLevel = 0;
        for (int depth = 0;; ++depth) {
            // factor_0 <= 1: nothing to simplify; further down the printed rule, below 1.
            const bool leaves = depth == 0 ? factor <= 1.0 : factor < 1.0;
            const auto firstNode = static_cast<std::uint32_t>(result_.block.nodes.size());
            for (const Piece& piece : level.pieces) {
                BuiltNode node;
                node.level = static_cast<std::uint8_t>(depth);
                node.parentInBlock = depth == 0 ? 0 : firstOfLevel + piece.parent;
                if (depth > 0) ++result_.block.nodes[node.parentInBlock].childCount;
                result_.block.nodes.push_back(node);
            }
            if (Result<void> done =
                    leaves ? finishLeaves(level, firstNode) : finishInner(level, factor, firstNode);
                !done) {
                return done;
            }
            if (leaves) return {};
            SplitCounters counters;
            level = splitLevel(mesh_, level, static_cast<int>(settings_.levelFactor), counters);
            result_.report.emptyPieces += counters.emptyPieces;
            firstOfLevel = firstNode;
            factor /= static_cast<double>(settings_.levelFactor);
        }
    }

    Result<void> finishLeaves(const Level& level, std::uint32_t firstNode) {
        for (std::size_t i = 0; i < level.pieces.size(); ++i) {
            std::vector<NodeTriangle> dressed = dressOriginal(mesh_, pieceOf(level, i));
            if (Result<void> done = finish(dressed, nullptr, 1.0, firstNode + i); !done) return done;
            result_.report.leafTriangles += dressed.size();
        }
        return {};
    }

    Result<void> finishInner(const Level& level, double factor, std::uint32_t firstNode) {
        std::vector<std::size_t> aims;
        for (const Piece& piece : level.pieces) aims.push_back(simplificationAim(piece.size(), factor));
        const std::vector<SimplifiedPiece> simplified =
            simplifyLevel(mesh_, level, aims, settings_.simplifier);
        std::vector<std::uint32_t> scratch(mesh_.positions.size(), kNone);
        const bool anyWelded =
            std::any_of(simplified.begin(), simplified.end(), [](const auto& s) { return s.welded; });
        std::vector<std::uint32_t> charts;
        if (anyWelded) charts = chartsOfWedges(mesh_, level.triangles);
        const double scale = 1.0 / std::sqrt(factor);
        for (std::size_t i = 0; i < level.pieces.size(); ++i) {
            const std::span<const MeshTriangle> piece = pieceOf(level, i);
            std::optional<PieceSurface> surface;
            std::vector<NodeTriangle> dressed;
            if (simplified[i].welded) {
                surface.emplace(mesh_, piece, textures_);
                dressed =
                    dressWelded({mesh_, piece, *surface, textures_, charts, scale}, simplified[i], scratch);
            } else {
                dressed = dressSeamed(mesh_, piece, simplified[i], scratch);
            }
            BuiltNode& node = result_.block.nodes[firstNode + i];
            node.geometricErrorMetres = static_cast<float>(
                measureError(mesh_, piece, dressed, simplified[i].errorGridUnits) * mesh_.grid.step);
            result_.report.stuckNodes += simplified[i].stuck ? 1 : 0;
            carried_ += simplified[i].carriedTriangles;
            if (Result<void> done = finish(dressed, surface ? &*surface : nullptr, scale, firstNode + i);
                !done)
                return done;
        }
        return {};
    }

    Result<void> finish(std::vector<NodeTriangle>& triangles, const PieceSurface* surface, double scale,
                        std::size_t nodeIndex) {
        const Atlas atlas = makeAtlas(
            triangles, {mesh_, textures_, surface, scale, static_cast<int>(settings_.maxTextureSide)});
        reduced_ += atlas.reduced ? 1 : 0;
        replaced_ += atlas.replaced ? 1 : 0;
        blurredRepeats_ += atlas.blurredRepeats;
        BuiltNode& node = result_.block.nodes[nodeIndex];
        NodeData data;
        if (atlas.image) {
            Result<NodeTexture> texture =
                encodeTexture(*atlas.image, codecFor(*atlas.image), static_cast<int>(settings_.jpegQuality));
            if (!texture) return passOn(texture);
            data.texture = std::move(*texture);
            node.textureWidth = data.texture.width;
            node.textureHeight = data.texture.height;
        }
        data.mesh = makeNodeMesh(mesh_, triangles, node.textureWidth, node.textureHeight);
        data.mesh.flags.alphaMask = data.mesh.flags.alphaMask || (atlas.image && atlas.image->channels == 4);
        measureNode(mesh_, triangles, data.mesh, node);
        FB_CHECK(result_.nodes.size() == nodeIndex);
        result_.nodes.push_back(std::move(data));
        return {};
    }

    [[nodiscard]] PayloadCodec codecFor(const Image& atlas) const {
        if (atlas.channels == 4 || settings_.textureCodec == TextureCodec::lossless) return PayloadCodec::png;
        if (settings_.textureCodec == TextureCodec::jpeg) return PayloadCodec::jpeg;
        return textures_.losslessFiles && textures_.texels <= kLosslessTexels ? PayloadCodec::png
                                                                              : PayloadCodec::jpeg;
    }

    [[nodiscard]] static std::span<const MeshTriangle> pieceOf(const Level& level, std::size_t i) {
        return {level.triangles.data() + level.pieces[i].begin, level.pieces[i].size()};
    }

    // Bounds and errors of parents contain their children's; children stand behind their parents.
    void growParents() {
        std::vector<BuiltNode>& nodes = result_.block.nodes;
        for (std::size_t i = nodes.size(); i-- > 1;) {
            BuiltNode& parent = nodes[nodes[i].parentInBlock];
            parent.bounds.grow(nodes[i].bounds);
            parent.geometricErrorMetres =
                std::max(parent.geometricErrorMetres, nodes[i].geometricErrorMetres);
        }
    }

    void reportResult() {
        BuildReport& report = result_.report;
        report.nodes = result_.block.nodes.size();
        for (const BuiltNode& node : result_.block.nodes) {
            if (node.childCount == 0)
                report.leafAreaSquareMetres += static_cast<double>(node.areaSquareMetres);
        }
        const std::string block = "block " + source_.name + ": ";
        if (carried_ > 0) {
            warn(block + std::to_string(carried_) +
                 " non-manifold triangles could not be simplified with OpenMesh");
        }
        if (reduced_ > 0) {
            warn(block + "the textures of " + std::to_string(reduced_) +
                 " nodes were made smaller to fit build.max_texture_side");
        }
        if (replaced_ > 0) {
            warn(block + std::to_string(replaced_) +
                 " nodes have too many texture parts for build.max_texture_side and are drawn in vertex "
                 "colours");
        }
        if (blurredRepeats_ > 0) {
            warn(block + std::to_string(blurredRepeats_) +
                 " texture parts repeat more than 8 times within a node and are stored less sharp");
        }
    }

    const SourceBlock& source_;
    const BuildSettings& settings_;
    TextureStore& store_;
    BlockTextures textures_;
    BlockMesh mesh_;
    BlockBuild result_;
    std::uint64_t reduced_ = 0, replaced_ = 0, blurredRepeats_ = 0, carried_ = 0;
};

}  // namespace

Result<BlockBuild> buildBlock(const SourceBlock& source, const BuildSettings& settings, TextureStore& store) {
    return BlockBuilder(source, settings, store).run();
}

}  // namespace fb
