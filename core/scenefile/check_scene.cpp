// `frontbench check`: everything that a scene says, held against everything else that it says.
#include <algorithm>
#include <cmath>

#include "scenefile/open_parts.h"

namespace fb {
namespace {

struct Checker {
    const std::filesystem::path& folder;
    const Progress& progress;
    SceneCheck found;

    // File names relative to the scene's folder: short lines.
    void fault(Error error) {
        const std::string inside = folder.string() + "/";
        if (error.file.starts_with(inside)) error.file.erase(0, inside.size());
        found.faults.push_back(error.oneLine());
    }
    void fault(const std::filesystem::path& file, std::string place, std::string reason) {
        fault(Error{Error::Kind::failed, file.string(), std::move(place), std::move(reason), {}});
    }
};

std::string nodePlace(NodeId node, const PayloadRef& payload) {
    return "node " + std::to_string(node) + " at byte " + std::to_string(payload.offset);
}

std::string disagreement(const char* of, std::uint64_t payload, std::uint64_t record) {
    return std::string("the payload has ") + std::to_string(payload) + " " + of + ", the record " +
           std::to_string(record);
}

// What the payload says of itself against what the hierarchy says of it; empty when they agree.
std::string compareCounts(const NodeData& data, const Hierarchy& h, NodeId n) {
    const NodeMesh& mesh = data.mesh;
    if (mesh.vertices.size() != h.vertices[n])
        return disagreement("vertices", mesh.vertices.size(), h.vertices[n]);
    if (mesh.texturedTriangles != h.texturedTriangles[n]) {
        return disagreement("textured triangles", mesh.texturedTriangles, h.texturedTriangles[n]);
    }
    if (mesh.untexturedTriangles != h.untexturedTriangles[n]) {
        return disagreement("untextured triangles", mesh.untexturedTriangles, h.untexturedTriangles[n]);
    }
    if (const std::uint32_t skirts = mesh.texturedSkirts + mesh.untexturedSkirts;
        skirts != h.skirtTriangles[n]) {
        return disagreement("skirt triangles", skirts, h.skirtTriangles[n]);
    }
    if (data.texture.width != h.textureWidth[n]) {
        return disagreement("texels across", data.texture.width, h.textureWidth[n]);
    }
    if (data.texture.height != h.textureHeight[n]) {
        return disagreement("texels down", data.texture.height, h.textureHeight[n]);
    }
    return {};
}

struct MeshFacts {
    bool insideBounds = true;  // once both are floats: rounding keeps order, so no slack is needed
    double areaSquareMetres = 0.0;
    double areaSlack = 0.0;  // what moving every corner by one step of the grid may change
};

MeshFacts measureMesh(const NodeMesh& mesh, const BlockGrid& grid, const Box3f& bounds) {
    MeshFacts facts;
    const auto position = [&](std::uint32_t index) {
        const NodeVertex& v = mesh.vertices[index];
        return grid.origin + grid.step * glm::dvec3(v.x, v.y, v.z);
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = position(mesh.indices[i]);
        const glm::dvec3 b = position(mesh.indices[i + 1]);
        const glm::dvec3 c = position(mesh.indices[i + 2]);
        for (const glm::dvec3& corner : {a, b, c}) {
            facts.insideBounds = facts.insideBounds && bounds.contains(glm::vec3(corner));
        }
        if (mesh.isSkirt(static_cast<std::uint32_t>(i / 3))) continue;
        facts.areaSquareMetres += 0.5 * glm::length(glm::cross(b - a, c - a));
        const double perimeter = glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, a);
        facts.areaSlack += (perimeter + 3.0 * grid.step) * grid.step;
    }
    return facts;
}

std::string checkMesh(const NodeMesh& mesh, const Hierarchy& h, NodeId n) {
    const MeshFacts facts = measureMesh(mesh, h.grids[h.block[n]], h.bounds[n]);
    if (!facts.insideBounds) return "a vertex lies outside the node's bounds";
    const double recorded = h.areaSquareMetres[n];
    const double slack = facts.areaSlack + 1.0e-4 * recorded;
    if (!(std::abs(facts.areaSquareMetres - recorded) <= slack)) {  // also when it is not finite
        return "the triangles' area is " + std::to_string(facts.areaSquareMetres) + " m2, the record says " +
               std::to_string(recorded);
    }
    return {};
}

void checkPayload(Checker& checker, const FileReader& pack, const Hierarchy& h, NodeId n) {
    const PayloadRef& payload = h.payload[n];
    const std::filesystem::path name = packName(payload.pack);
    Result<std::vector<std::uint8_t>> bytes = readVerified(pack, payload, "node " + std::to_string(n));
    if (!bytes) return checker.fault(bytes.error());
    ++checker.found.payloads;
    checker.found.bytes += bytes->size();

    const std::string what = name.string() + ": " + nodePlace(n, payload);
    Result<NodeData> data = parsePayload(*bytes, what);
    if (!data) return checker.fault(data.error());
    if (std::string differs = compareCounts(*data, h, n); !differs.empty()) {
        return checker.fault(name, nodePlace(n, payload), std::move(differs));
    }
    if (std::string wrong = checkMesh(data->mesh, h, n); !wrong.empty()) {
        return checker.fault(name, nodePlace(n, payload), std::move(wrong));
    }
    Result<DecodedNode> decoded = decodeNode(*data, h.grids[h.block[n]], what);
    if (!decoded) return checker.fault(decoded.error());
    if (decoded->sizeBytes() != h.residentBytes[n]) {
        checker.fault(name, nodePlace(n, payload),
                      disagreement("bytes in memory", decoded->sizeBytes(), h.residentBytes[n]));
    }
}

// Joined again, the packs must give the very hierarchy.bin that is there.
void compareWithPacks(Checker& checker, const HierarchyFile& file, const std::vector<BuiltBlock>& blocks) {
    const std::vector<std::uint8_t> there = encodeHierarchyFile(file);
    const std::vector<std::uint8_t> again = encodeHierarchyFile({joinBlocks(blocks), file.packs});
    if (there == again) return;
    // The header's checksums differ too, so the place is that of the first difference behind it.
    std::size_t at = kHierarchyHeaderBytes;
    while (at < std::min(there.size(), again.size()) && there[at] == again[at]) ++at;
    const std::uint64_t nodes = kHierarchyHeaderBytes + file.packs.size() * kBlockRecordBytes;
    checker.fault("hierarchy.bin",
                  at < nodes ? "block table" : "node " + std::to_string((at - nodes) / kNodeRecordBytes),
                  "differs from what the packs say of their nodes");
}

Result<void> checkPacks(Checker& checker, const HierarchyFile& file) {
    const Hierarchy& h = file.hierarchy;
    std::vector<std::vector<NodeId>> nodesOf(file.packs.size());
    for (NodeId n = 0; n < h.size(); ++n) nodesOf[h.block[n]].push_back(n);
    std::vector<BuiltBlock> blocks;
    std::uint64_t done = 0;
    for (std::size_t b = 0; b < file.packs.size(); ++b) {
        Result<FileReader> pack = openPack(checker.folder, file.packs[b]);
        if (!pack) {
            checker.fault(pack.error());
            done += nodesOf[b].size();
            continue;
        }
        Result<PackTrailer> frame = readPackFrame(*pack, file.packs[b].number);
        if (frame)
            blocks.push_back(std::move(frame->block));
        else
            checker.fault(frame.error());
        for (NodeId n : nodesOf[b]) {
            checkPayload(checker, *pack, h, n);
            ++done;
            const double fraction = static_cast<double>(done) / h.size();
            if (checker.progress && !checker.progress("check", fraction)) {
                return failure(checker.folder.string(), {}, "the check was stopped");
            }
        }
    }
    if (blocks.size() == file.packs.size()) compareWithPacks(checker, file, blocks);
    return {};
}

}  // namespace

Result<SceneCheck> checkScene(const std::filesystem::path& folder, const Progress& progress) {
    if (Result<void> there = checkSceneFolder(folder); !there) return passOn(there);
    Checker checker{folder, progress, {}};
    Result<SceneToml> toml = readSceneToml(folder);
    if (!toml) checker.fault(toml.error());
    Result<OpenedHierarchy> hierarchy = readHierarchy(folder);
    if (!hierarchy) {
        checker.fault(hierarchy.error());
        return std::move(checker.found);
    }
    if (toml) {
        if (Result<void> same = checkBelongTogether(folder, *toml, *hierarchy); !same)
            checker.fault(same.error());
    }
    if (Result<void> all = checkPacks(checker, hierarchy->file); !all) return passOn(all);
    return std::move(checker.found);
}

}  // namespace fb
