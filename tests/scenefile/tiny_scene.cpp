#include "scenefile/tiny_scene.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/random.h"

namespace fb::test {

namespace {

// In memory where that can be: these tests sync many small files.
std::filesystem::path quickFolder() {
    const std::filesystem::path memory = "/dev/shm";
    const bool writable = ::access(memory.c_str(), W_OK | X_OK) == 0;
    return writable ? memory : std::filesystem::temp_directory_path();
}

}  // namespace

TemporaryFolder::TemporaryFolder() : ScratchFolder(quickFolder()) {}

Bytes readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void overwrite(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    // In place: some file systems write a file to disk at once that was emptied and filled again.
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    const auto size = static_cast<ssize_t>(bytes.size());
    if (file < 0 || ::pwrite(file, bytes.data(), bytes.size(), 0) != size || ::ftruncate(file, size) != 0)
        std::abort();
    ::close(file);
}

NodeTexture makeTexture(PayloadCodec codec, std::uint16_t width, std::uint16_t height, std::uint8_t channels,
                        const Bytes& pixels) {
    NodeTexture texture{codec, width, height, channels, {}};
    const char* name = codec == PayloadCodec::jpeg ? "texture.jpg" : "texture.png";
    OIIO::Filesystem::IOVecOutput memory;
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(name);
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Compression", "jpeg:92");
    if (channels == 2) spec.channelnames = {"Y", "A"};
    if (channels % 2 == 0) spec.alpha_channel = channels - 1;
    out->set_ioproxy(&memory);
    if (!out->open(name, spec) || !out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !out->close())
        std::abort();
    texture.encoded = memory.buffer();
    return texture;
}

NodeTexture makeTexture(PayloadCodec codec, std::uint16_t width, std::uint16_t height, std::uint8_t channels,
                        std::uint64_t seed) {
    Random random(seed);
    Bytes pixels(std::size_t{width} * height * channels);
    for (std::uint8_t& value : pixels) value = static_cast<std::uint8_t>(random.index(256));
    return makeTexture(codec, width, height, channels, pixels);
}

NodeData oneTriangle(std::uint32_t at, NodeTexture texture) {
    NodeData node;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
        NodeVertex v{};
        v.x = at + (corner == 1 ? 4 : 0);
        v.y = at + (corner == 2 ? 4 : 0);
        v.z = at;
        encodeNormal({0, 0, 1}, v.normal);
        v.u = static_cast<std::uint16_t>(corner == 1 ? 65535 : 0);
        v.v = static_cast<std::uint16_t>(corner == 2 ? 65535 : 0);
        for (std::uint8_t& c : v.colour) c = 255;
        node.mesh.vertices.push_back(v);
    }
    node.mesh.indices = {0, 1, 2};
    const bool textured = texture.codec != PayloadCodec::none;
    node.mesh.texturedTriangles = textured ? 1 : 0;
    node.mesh.untexturedTriangles = textured ? 0 : 1;
    node.texture = std::move(texture);
    return node;
}

TinyBlock tinyBlock(std::uint32_t children, NodeTexture texture) {
    TinyBlock block;
    block.nodes.push_back({oneTriangle(8, texture), 0, children, 0});
    for (std::uint32_t i = 0; i < children; ++i)
        block.nodes.push_back({oneTriangle(8 * (i + 1), texture), 0, 0, 1});
    return block;
}

namespace {

BuiltNode recordOf(const TinyBlock::Node& node, const BlockGrid& grid) {
    const NodeMesh& mesh = node.data.mesh;
    BuiltNode record;
    record.parentInBlock = node.parent;
    record.childCount = node.children;
    record.level = node.level;
    record.texturedTriangles = mesh.texturedTriangles;
    record.untexturedTriangles = mesh.untexturedTriangles;
    record.vertices = static_cast<std::uint32_t>(mesh.vertices.size());
    record.bounds.grow(glm::vec3(grid.origin));
    const auto position = [&](std::size_t index) {
        const NodeVertex& v = mesh.vertices[mesh.indices[index]];
        return grid.origin + grid.step * glm::dvec3(v.x, v.y, v.z);
    };
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) record.bounds.grow(glm::vec3(position(i + k)));
        area += glm::length(glm::cross(position(i + 1) - position(i), position(i + 2) - position(i))) / 2.0;
    }
    const auto triangles = static_cast<double>(mesh.indices.size()) / 3.0;
    record.areaSquareMetres = static_cast<float>(area);
    record.staticBenefit = static_cast<float>(std::sqrt(area * triangles));
    record.averageNormal = {0, 0, 1};
    record.normalCoherence = 1.0f;
    record.geometricErrorMetres = node.children > 0 ? 0.5f : 0.0f;
    record.textureWidth = node.data.texture.width;
    record.textureHeight = node.data.texture.height;
    return record;
}

}  // namespace

BuiltBlock writePack(const std::filesystem::path& folder, std::uint32_t number, const TinyBlock& block) {
    BuiltBlock built;
    built.grid = block.grid;
    Result<PackWriter> pack = PackWriter::create(folder, number);
    if (!pack) std::abort();
    for (const TinyBlock::Node& node : block.nodes) {
        built.nodes.push_back(recordOf(node, block.grid));
        built.nodes.back().payload = pack->append(encodePayload(node.data).value()).value();
    }
    // Breadth first, so going backwards meets every child before its parent.
    for (std::size_t i = built.nodes.size(); i-- > 1;) {
        BuiltNode& parent = built.nodes[built.nodes[i].parentInBlock];
        parent.bounds.grow(built.nodes[i].bounds);
        parent.geometricErrorMetres =
            std::max(parent.geometricErrorMetres, built.nodes[i].geometricErrorMetres);
    }
    if (!pack->finish(built, kSettingsHash, kBlockHash)) std::abort();
    return built;
}

SceneInfo tinyInfo() {
    SceneInfo info;
    info.name = "tiny";
    info.program = "frontbench test";
    info.bounds = {glm::dvec3(0.0), glm::dvec3(1.0)};
    return info;
}

std::vector<BuiltBlock> writeTinyScene(const std::filesystem::path& folder,
                                       const std::vector<TinyBlock>& blocks) {
    std::vector<BuiltBlock> built;
    for (const TinyBlock& block : blocks) {
        built.push_back(writePack(folder, static_cast<std::uint32_t>(built.size()), block));
    }
    const Result<void> written = writeScene(folder, tinyInfo(), built);
    EXPECT_TRUE(written) << lineOf(written);
    return built;
}

std::vector<std::string> faultsOf(const std::filesystem::path& folder) {
    Result<SceneCheck> check = checkScene(folder, {});
    return check ? check->faults : std::vector<std::string>{check.error().oneLine()};
}

std::string soleFault(const std::filesystem::path& folder) {
    const std::vector<std::string> faults = faultsOf(folder);
    return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
}

}  // namespace fb::test
