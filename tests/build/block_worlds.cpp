#include "block_worlds.h"

#include <cmath>
#include <numbers>

namespace fb::test {

SourceMesh makeSheet(const Sheet& sheet) {
    SourceMesh mesh;
    for (int y = 0; y <= sheet.rows; ++y) {
        for (int x = 0; x <= sheet.columns; ++x) {
            const double u = static_cast<double>(x) / sheet.columns, v = static_cast<double>(y) / sheet.rows;
            const double px = u * sheet.width, py = v * sheet.height;
            mesh.positions.emplace_back(px, py, sheet.lift ? sheet.lift(px, py) : 0.0);
            mesh.uvs.emplace_back(static_cast<float>(u), static_cast<float>(v));
        }
    }
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (sheet.columns + 1) + x); };
    for (int y = 0; y < sheet.rows; ++y) {
        for (int x = 0; x < sheet.columns; ++x) {
            mesh.triangles.emplace_back(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            mesh.triangles.emplace_back(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    }
    return mesh;
}

SourceMesh makeSphere(int slices, int stacks) {
    SourceMesh mesh;
    mesh.positions.emplace_back(0, 0, 1);
    for (int j = 1; j < stacks; ++j) {
        const double polar = std::numbers::pi * j / stacks;
        for (int i = 0; i < slices; ++i) {
            const double around = 2.0 * std::numbers::pi * i / slices;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(around),
                                        std::sin(polar) * std::sin(around), std::cos(polar));
        }
    }
    mesh.positions.emplace_back(0, 0, -1);
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(1 + (j - 1) * slices + i % slices);
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int i = 0; i < slices; ++i) {
        mesh.triangles.emplace_back(0u, at(i, 1), at(i + 1, 1));
        for (int j = 1; j + 1 < stacks; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
        mesh.triangles.emplace_back(at(i, stacks - 1), last, at(i + 1, stacks - 1));
    }
    return mesh;
}

SourceBlock blockOf(SourceMesh mesh, std::shared_ptr<const Image> image) {
    SourceBlock block;
    block.name = "test";
    block.materials.push_back({"paint", glm::vec4(1.0f), -1, false});
    if (image) {
        block.materials[0].texture = 0;
        block.textures.push_back({"picture", {}, {}, std::move(image)});
    }
    mesh.materials.assign(mesh.triangles.size(), 0);
    block.mesh = std::move(mesh);
    return block;
}

std::shared_ptr<const Image> paintImage(int width, int height,
                                        const std::function<glm::u8vec3(int, int)>& paint) {
    auto image = std::make_shared<Image>(Image{width, height, 3, {}, true});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::u8vec3 colour = paint(x, y);
            for (int c = 0; c < 3; ++c) image->pixels.push_back(colour[c]);
        }
    }
    return image;
}

double areaOf(const SourceMesh& mesh) {
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t.x];
        area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    }
    return area;
}

double areaOf(const BlockMesh& mesh, std::span<const MeshTriangle> triangles) {
    double area = 0.0;
    for (const MeshTriangle& t : triangles) {
        const glm::dvec3 cross = crossOf(mesh.at(t.wedges.x), mesh.at(t.wedges.y), mesh.at(t.wedges.z));
        area += 0.5 * glm::length(cross) * mesh.grid.step * mesh.grid.step;
    }
    return area;
}

}  // namespace fb::test
