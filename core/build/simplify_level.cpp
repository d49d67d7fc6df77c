#include "build/simplify_level.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "build/numbering.h"
#include "build/simplify_mesh.h"
#include "build/stand_ins.h"

namespace fb {
namespace {

// A piece of few triangles keeps this many: fewer save nothing and show.
constexpr std::size_t kSmallestAim = 4;
// Clustering moves vertices off the cuts and leaves gaps there: only for pieces that are hopeless otherwise.
constexpr double kHopelessFactor = 3.0;

// Seams are welded, and colours carried over to a new atlas, where keeping them makes the error so many times
// larger.
constexpr double kSeamCost = 1.5, kOneUnit = 1.0;

struct TaggedTriangle {
    glm::uvec3 ids;  // wedges or positions
    std::uint32_t piece;
};

// Input of a simplifier together with what its vertices are.
struct Task {
    SimplifyInput input;
    std::vector<std::uint32_t> ids;     // by vertex: wedge or position
    std::vector<std::uint32_t> pieces;  // by vertex

    std::uint32_t placeCount = 0;

    // Whether a piece has two vertices at one place.
    [[nodiscard]] bool hasSeams() const {
        if (pieces.empty() || pieces.front() == pieces.back()) return ids.size() > placeCount;  // one piece
        std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;
        for (std::size_t i = 0; i < pieces.size(); ++i) seen.emplace_back(pieces[i], input.places[i]);
        std::ranges::sort(seen);
        return std::ranges::adjacent_find(seen) != seen.end();
    }
};

enum class Seams : std::uint8_t { kept, welded };
enum class Cuts : std::uint8_t { seams, locked };

class LevelSimplifier {
  public:
    LevelSimplifier(BlockMesh& mesh, const Level& level, Simplifier simplifier)
        : mesh_(mesh),
          level_(level),
          simplifier_(simplifier),
          vertices_(std::max(mesh.wedges.size(), mesh.positions.size())),
          places_(mesh.positions.size()) {}

    std::vector<SimplifiedPiece> run(std::span<const std::size_t> wanted) {
        const std::size_t pieces = level_.pieces.size();
        std::vector<std::size_t> aims;
        for (std::size_t i = 0; i < pieces; ++i) aims.push_back(withoutSmallParts(i, wanted[i]));
        Seams seams = Seams::kept;
        std::vector<std::vector<glm::uvec3>> joint(pieces);
        std::uint64_t jointCarried = 0;
        const std::size_t jointAim = std::accumulate(aims.begin(), aims.end(), std::size_t{0});
        const bool together = pieces > 1 && level_.triangles.size() > jointAim;
        if (together) {
            Joint result = simplifyTogether(Seams::kept, jointAim);
            if (result.hasSeams && (tellsErrors() || isStuck(result.triangles.size(), jointAim))) {
                Joint welded = simplifyTogether(Seams::welded, jointAim);
                const bool isFewer = welded.triangles.size() < result.triangles.size();
                if ((isStuck(result.triangles.size(), jointAim) && isFewer) ||
                    isCostly(result.errorGridUnits, welded.errorGridUnits)) {
                    seams = Seams::welded;
                    result = std::move(welded);
                }
            }
            for (const TaggedTriangle& t : result.triangles) joint[t.piece].push_back(t.ids);
            jointCarried = result.carriedTriangles;
        } else {
            for (std::size_t i = 0; i < pieces; ++i) joint[i] = original(i, Seams::kept);
        }
        std::vector<SimplifiedPiece> result(pieces);
        for (std::size_t i = 0; i < pieces; ++i) {
            if (aims[i] > 0) {
                result[i] =
                    simplifyAlone(i, joint[i], seams, {aims[i], together ? mostTriangles(aims[i]) : aims[i]});
            }
            addStandIns(result[i], i);
        }
        if (pieces > 0) result[0].carriedTriangles += jointCarried;
        return result;
    }

  private:
    struct Joint {
        std::vector<TaggedTriangle> triangles;
        std::uint64_t carriedTriangles = 0;
        double errorGridUnits = 0.0;
        bool hasSeams = false;  // of textures or colours, which were kept
    };

    // What a piece should have, and what it is simplified to when it has more than that.
    struct Aim {
        std::size_t wanted, target;
    };

    static bool isStuck(std::size_t triangles, std::size_t aim) {
        return static_cast<double>(triangles) > kStuckFactor * static_cast<double>(aim);
    }
    [[nodiscard]] bool tellsErrors() const { return simplifier_ == Simplifier::meshoptimizer; }
    // Keeping seams moves the surface too far.
    static bool isCostly(double kept, double welded) { return kept > kSeamCost * welded + kOneUnit; }
    static std::size_t mostTriangles(std::size_t aim) {
        return static_cast<std::size_t>(kStuckFactor * static_cast<double>(aim));
    }

    [[nodiscard]] SimplifyOutput simplify(const SimplifyInput& input) const {
        return simplifier_ == Simplifier::openMesh ? simplifyWithOpenMesh(input)
                                                   : simplifyWithMeshoptimizer(input);
    }

    [[nodiscard]] std::uint32_t positionOf(std::uint32_t id, Seams seams) const {
        return seams == Seams::kept ? mesh_.wedges[id].position : id;
    }

    // Collapses along a straight line leave some.
    [[nodiscard]] bool hasNoArea(const glm::uvec3& ids, Seams seams) const {
        return isDegenerate(mesh_.positions[positionOf(ids.x, seams)],
                            mesh_.positions[positionOf(ids.y, seams)],
                            mesh_.positions[positionOf(ids.z, seams)]);
    }

    // What is left of the aim for the rest of the piece; 0 where nothing is left of the piece.
    std::size_t withoutSmallParts(std::size_t piece, std::size_t aim) {
        standIns_.emplace_back();
        const std::vector<glm::uvec3> triangles = original(piece, Seams::welded);
        standIns_[piece] = makeStandIns(mesh_, triangles, aim, places_);
        const StandIns& made = standIns_[piece];
        if (made.empty()) return aim;
        const auto left = static_cast<std::size_t>(std::ranges::count(made.replaced, std::uint8_t{0}));
        const std::size_t rest = aim > made.triangles.size() ? aim - made.triangles.size() : 0;
        return std::min(left, std::max(rest, kSmallestAim));
    }

    void addStandIns(SimplifiedPiece& simplified, std::size_t piece) const {
        const StandIns& made = standIns_[piece];
        if (made.empty()) return;
        if (!simplified.welded) weld(simplified.triangles);
        simplified.welded = true;
        simplified.triangles.insert(simplified.triangles.end(), made.triangles.begin(), made.triangles.end());
        std::vector<std::uint32_t>& replaced = simplified.replaced;
        for (std::uint32_t t = 0; t < made.replaced.size(); ++t) {
            if (made.replaced[t] == 0) continue;
            const glm::uvec3& wedges = level_.triangles[level_.pieces[piece].begin + t].wedges;
            for (int k = 0; k < 3; ++k) replaced.push_back(mesh_.wedges[wedges[k]].position);
        }
        std::ranges::sort(replaced);
        replaced.erase(std::unique(replaced.begin(), replaced.end()), replaced.end());
    }

    // The piece's triangles before simplification, but for those that have stand-ins.
    [[nodiscard]] std::vector<glm::uvec3> original(std::size_t piece, Seams seams) const {
        std::vector<glm::uvec3> result;
        const std::uint32_t begin = level_.pieces[piece].begin;
        for (std::uint32_t t = begin; t < level_.pieces[piece].end; ++t) {
            if (!standIns_[piece].empty() && standIns_[piece].replaced[t - begin] != 0) continue;
            result.push_back(level_.triangles[t].wedges);
        }
        if (seams == Seams::welded) weld(result);
        return result;
    }

    void weld(std::vector<glm::uvec3>& triangles) const {
        for (glm::uvec3& t : triangles) {
            for (int k = 0; k < 3; ++k) t[k] = mesh_.wedges[t[k]].position;
        }
    }

    // `triangles` in the order of their pieces.
    [[nodiscard]] Task makeTask(const std::vector<TaggedTriangle>& triangles, Seams seams, Cuts cuts) {
        Task task;
        places_.restart();
        std::uint32_t piece = kNone;
        for (const TaggedTriangle& triangle : triangles) {
            if (triangle.piece != piece) vertices_.restart(static_cast<std::uint32_t>(task.ids.size()));
            piece = triangle.piece;
            glm::uvec3 local;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t id = triangle.ids[k];
                const auto [vertex, isNew] = vertices_.take(id);
                local[k] = vertex;
                if (!isNew) continue;
                const std::uint32_t position = positionOf(id, seams);
                task.ids.push_back(id);
                task.pieces.push_back(triangle.piece);
                task.input.points.emplace_back(mesh_.positions[position]);
                task.input.places.push_back(places_.take(position).value);
                task.input.locked.push_back(cuts == Cuts::locked ? mesh_.onCut[position] : std::uint8_t{0});
            }
            task.input.triangles.push_back(local);
        }
        task.placeCount = places_.next();
        return task;
    }

    [[nodiscard]] Joint simplifyTogether(Seams seams, std::size_t aim) {
        std::vector<TaggedTriangle> all;
        all.reserve(level_.triangles.size());
        for (std::size_t i = 0; i < level_.pieces.size(); ++i) {
            for (const glm::uvec3& ids : original(i, seams))
                all.push_back({ids, static_cast<std::uint32_t>(i)});
        }
        Task task = makeTask(all, seams, Cuts::seams);
        task.input.targetTriangles = aim;
        const SimplifyOutput output = simplify(task.input);
        Joint joint{
            {}, output.carriedTriangles, output.errorGridUnits, seams == Seams::kept && task.hasSeams()};
        for (const glm::uvec3& t : output.triangles) {
            const glm::uvec3 ids(task.ids[t.x], task.ids[t.y], task.ids[t.z]);
            if (!hasNoArea(ids, seams)) joint.triangles.push_back({ids, task.pieces[t.x]});
        }
        return joint;
    }

    struct Attempt {
        SimplifiedPiece piece;
        double errorGridUnits = 0.0;
        bool hasSeams = false;  // which were kept
    };

    [[nodiscard]] Attempt simplifyOnce(const std::vector<glm::uvec3>& triangles, Seams seams, std::size_t aim,
                                       bool sloppy) {
        std::vector<TaggedTriangle> tagged;
        tagged.reserve(triangles.size());
        for (const glm::uvec3& ids : triangles) tagged.push_back({ids, 0});
        Task task = makeTask(tagged, seams, Cuts::locked);
        task.input.targetTriangles = aim;
        const SimplifyOutput output = sloppy ? simplifySloppily(task.input) : simplify(task.input);
        Attempt made{{}, output.errorGridUnits, seams == Seams::kept && task.hasSeams()};
        SimplifiedPiece& result = made.piece;
        result.welded = seams == Seams::welded;
        result.clustered = sloppy;
        result.carriedTriangles = output.carriedTriangles;
        for (const glm::uvec3& t : output.triangles) {
            const glm::uvec3 ids(task.ids[t.x], task.ids[t.y], task.ids[t.z]);
            if (!hasNoArea(ids, seams)) result.triangles.push_back(ids);
        }
        return made;
    }

    [[nodiscard]] SimplifiedPiece simplifyAlone(std::size_t piece, std::vector<glm::uvec3> start, Seams seams,
                                                const Aim& aim) {
        if (start.empty()) {  // the first step collapsed all of it
            start = original(piece, Seams::kept);
            seams = Seams::kept;
        }
        SimplifiedPiece best;
        best.triangles = start;
        best.welded = seams == Seams::welded;
        const auto take = [&](Attempt& next) {
            if (!next.piece.triangles.empty() && next.piece.triangles.size() < best.triangles.size())
                best = std::move(next.piece);
        };
        const auto attempt = [&](Seams how, bool sloppy) {
            Attempt next = simplifyOnce(start, how, aim.target, sloppy);
            take(next);
        };
        if (best.triangles.size() > aim.target) {
            Attempt kept = simplifyOnce(start, seams, aim.target, false);
            if (kept.hasSeams && tellsErrors()) {
                std::vector<glm::uvec3> welded = start;
                weld(welded);
                Attempt other = simplifyOnce(welded, Seams::welded, aim.target, false);
                if (isCostly(kept.errorGridUnits, other.errorGridUnits)) {
                    start = std::move(welded);
                    seams = Seams::welded;
                    kept = std::move(other);
                }
            }
            take(kept);
        }
        if (isStuck(best.triangles.size(), aim.wanted)) {
            if (seams == Seams::kept) {
                weld(start);
                attempt(Seams::welded, false);
            }
            const auto triangles = static_cast<double>(best.triangles.size());
            if (triangles > kHopelessFactor * static_cast<double>(aim.wanted)) attempt(Seams::welded, true);
        }
        best.stuck = isStuck(best.triangles.size(), aim.wanted);
        return best;
    }

    BlockMesh& mesh_;
    const Level& level_;
    Simplifier simplifier_;
    std::vector<StandIns> standIns_;  // by piece
    Numbering vertices_, places_;
};

}  // namespace

std::uint32_t SimplifiedPiece::drawnAt(std::uint32_t position) const {
    const auto found = std::ranges::lower_bound(moved, position, {}, &MovedVertex::from);
    return found != moved.end() && found->from == position ? found->to : position;
}

std::size_t simplificationAim(std::size_t triangles, double factor) {
    const double aim = std::ceil(static_cast<double>(triangles) / factor);
    return std::max(static_cast<std::size_t>(aim), std::min(triangles, kSmallestAim));
}

std::vector<SimplifiedPiece> simplifyLevel(BlockMesh& mesh, const Level& level,
                                           std::span<const std::size_t> aims, Simplifier simplifier) {
    FB_CHECK(aims.size() == level.pieces.size());
    return LevelSimplifier(mesh, level, simplifier).run(aims);
}

}  // namespace fb
