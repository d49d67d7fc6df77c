#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "build/build_scene.h"
#include "build/check_block.h"
#include "build/finish_node.h"
#include "build/make_atlas.h"
#include "build/measure_error.h"
#include "build/quantise_block.h"
#include "build/skirts.h"

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
        BuildPhases& phases = result_.report.phases;
        phaseStart_ = SteadyClock::now();
        textures_ = decodeTextures(source_, store_);
        QuantisedBlock quantised = quantiseBlock(source_, textures_);
        reportSource(quantised);
        mesh_ = std::move(quantised.mesh);
        Level root;
        root.triangles = std::move(quantised.triangles);
        if (root.triangles.empty()) {
            warn("block " + source_.name + " has no triangles and is left out");
            result_.report.add(countsOf(result_.block));
            return std::move(result_);
        }
        phases.textures += secondsSinceLap(phaseStart_);
        result_.block.grid = mesh_.grid;
        root.pieces.push_back({0, 0, static_cast<std::uint32_t>(root.triangles.size())});
        SplitCounters counters;
        const std::vector<BlockLevel> levels = makeLevels(mesh_, std::move(root), settings_, counters);
        result_.report.emptyPieces += counters.emptyPieces;
        phases.simplify += secondsSinceLap(phaseStart_);
        if (Result<void> finished = finishLevels(levels); !finished) return passOn(finished);
        growParents();
        reportResult();
        return std::move(result_);
    }

  private:
    void warn(std::string line) { result_.report.warnings.push_back(std::move(line)); }

    void reportSource(const QuantisedBlock& quantised) {
        result_.block.sourceTriangles = source_.mesh.triangles.size();
        result_.block.sourceAreaSquareMetres = quantised.sourceAreaSquareMetres;
        for (std::string& line : textures_.warnings) warn(std::move(line));
        if (quantised.unusableUvs > 0) {
            warn("block " + source_.name + ": " + std::to_string(quantised.unusableUvs) +
                 " triangles with absurd texture coordinates are drawn in their base colour");
        }
    }

    // From the root to the leaves: nodes come breadth first.
    Result<void> finishLevels(const std::vector<BlockLevel>& levels) {
        const std::vector<std::vector<double>> errors = measureErrors(mesh_, levels);
        result_.report.phases.errors += secondsSinceLap(phaseStart_);
        const std::vector<std::vector<Skirts>> skirts = planSkirts(mesh_, levels, errors);
        result_.report.phases.skirts += secondsSinceLap(phaseStart_);
        std::size_t firstOfLevel = 0;
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const std::size_t firstNode = result_.block.nodes.size();
            for (std::size_t i = 0; i < levels[l].original.pieces.size(); ++i) {
                BuiltNode node;
                node.level = static_cast<std::uint8_t>(l);
                if (l > 0) {
                    node.parentInBlock =
                        static_cast<std::uint32_t>(firstOfLevel + levels[l].original.pieces[i].parent);
                    ++result_.block.nodes[node.parentInBlock].childCount;
                }
                node.geometricErrorMetres = static_cast<float>(errors[l][i] * mesh_.grid.step);
                node.borderErrorMetres = static_cast<float>(skirts[l][i].gapGridUnits * mesh_.grid.step);
                result_.block.nodes.push_back(node);
            }
            const Result<void> done = levels[l].isLeaves() ? finishLeaves(levels[l], skirts[l])
                                                           : finishInner(levels[l], skirts[l]);
            if (!done) return done;
            firstOfLevel = firstNode;
        }
        return {};
    }

    Result<void> finishLeaves(const BlockLevel& level, const std::vector<Skirts>& skirts) {
        for (std::size_t i = 0; i < level.original.pieces.size(); ++i) {
            std::vector<NodeTriangle> dressed = dressOriginal(mesh_, level.piece(i));
            if (Result<void> done = finish(dressed, nullptr, 1.0, skirts[i]); !done) return done;
        }
        return {};
    }

    Result<void> finishInner(const BlockLevel& level, const std::vector<Skirts>& skirts) {
        std::vector<std::uint32_t> scratch(mesh_.positions.size(), kNone);
        const bool anyWelded = std::any_of(level.simplified.begin(), level.simplified.end(),
                                           [](const SimplifiedPiece& s) { return s.welded; });
        std::vector<std::uint32_t> charts;
        if (anyWelded) charts = chartsOfWedges(mesh_, level.original.triangles);
        const double scale = 1.0 / std::sqrt(level.factor);
        for (std::size_t i = 0; i < level.simplified.size(); ++i) {
            const SimplifiedPiece& simplified = level.simplified[i];
            std::optional<PieceSurface> surface;
            std::vector<NodeTriangle> dressed;
            if (simplified.welded) {
                surface.emplace(mesh_, level.piece(i), textures_);
                dressed = dressWelded({mesh_, level.piece(i), *surface, textures_, charts, scale}, simplified,
                                      scratch);
            } else {
                dressed = dressSeamed(mesh_, level.piece(i), simplified, scratch);
            }
            for (NodeTriangle& t : dressed) {
                for (int k = 0; k < 3; ++k) t.positions[k] = simplified.drawnAt(t.positions[k]);
            }
            result_.block.nodes[result_.nodes.size()].stuck = simplified.stuck;
            carried_ += simplified.carriedTriangles;
            if (Result<void> done = finish(dressed, surface ? &*surface : nullptr, scale, skirts[i]); !done)
                return done;
        }
        return {};
    }

    // The next node.
    Result<void> finish(std::vector<NodeTriangle>& triangles, const PieceSurface* surface, double scale,
                        const Skirts& skirts) {
        BuildPhases& phases = result_.report.phases;
        phases.dress += secondsSinceLap(phaseStart_);
        const Atlas atlas = makeAtlas(
            triangles, {mesh_, textures_, surface, scale, static_cast<int>(settings_.maxTextureSide)});
        reduced_ += atlas.reduced ? 1 : 0;
        replaced_ += atlas.replaced ? 1 : 0;
        blurredRepeats_ += atlas.blurredRepeats;
        addSkirts(triangles, mesh_, skirts);
        phases.atlas += secondsSinceLap(phaseStart_);
        BuiltNode& node = result_.block.nodes[result_.nodes.size()];
        NodeData data;
        if (atlas.image) {
            Result<NodeTexture> texture =
                encodeTexture(*atlas.image, codecFor(*atlas.image), static_cast<int>(settings_.jpegQuality));
            if (!texture) return passOn(texture);
            data.texture = std::move(*texture);
            node.textureWidth = data.texture.width;
            node.textureHeight = data.texture.height;
        }
        phases.encode += secondsSinceLap(phaseStart_);
        data.mesh = makeNodeMesh(mesh_, triangles, node.textureWidth, node.textureHeight);
        data.mesh.flags.alphaMask = data.mesh.flags.alphaMask || (atlas.image && atlas.image->channels == 4);
        measureNode(mesh_, triangles, data.mesh, node);
        result_.nodes.push_back(std::move(data));
        return {};
    }

    [[nodiscard]] PayloadCodec codecFor(const Image& atlas) const {
        if (atlas.channels == 4 || settings_.textureCodec == TextureCodec::lossless) return PayloadCodec::png;
        if (settings_.textureCodec == TextureCodec::jpeg) return PayloadCodec::jpeg;
        return textures_.losslessFiles && textures_.texels <= kLosslessTexels ? PayloadCodec::png
                                                                              : PayloadCodec::jpeg;
    }

    // Bounds of parents contain their children's (so do errors, by measureErrors); children stand behind.
    void growParents() {
        std::vector<BuiltNode>& nodes = result_.block.nodes;
        for (std::size_t i = nodes.size(); i-- > 1;) {
            BuiltNode& parent = nodes[nodes[i].parentInBlock];
            parent.bounds.grow(nodes[i].bounds);
        }
    }

    void reportResult() {
        result_.report.add(countsOf(result_.block));
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
    SteadyClock::time_point phaseStart_;
    std::uint64_t reduced_ = 0, replaced_ = 0, blurredRepeats_ = 0, carried_ = 0;
};

}  // namespace

Result<BlockBuild> buildBlock(const SourceBlock& source, const BuildSettings& settings, TextureStore& store) {
    return BlockBuilder(source, settings, store).run();
}

}  // namespace fb
