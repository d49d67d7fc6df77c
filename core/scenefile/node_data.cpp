#include "scenefile/node_data.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

constexpr double kSnorm16 = 32767.0;

std::int16_t toSnorm16(double value) {
    return static_cast<std::int16_t>(std::floor(std::clamp(value, -1.0, 1.0) * kSnorm16 + 0.5));
}

}  // namespace

// Octahedral mapping (Meyer et al. 2010, "On floating-point normal vectors"): the unit sphere projected on an
// octahedron whose lower half is folded over the upper one.
glm::vec3 decodeNormal(const std::int16_t normal[2]) {
    double x = std::max(normal[0] / kSnorm16, -1.0);
    double y = std::max(normal[1] / kSnorm16, -1.0);
    const double z = 1.0 - std::abs(x) - std::abs(y);
    const double fold = std::max(-z, 0.0);
    x += x >= 0.0 ? -fold : fold;
    y += y >= 0.0 ? -fold : fold;
    const double length = std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

// An unknown direction (zero or not finite) is stored as +z. Only operations that IEEE 754 rounds in one way
// are used: the same bytes on every machine.
void encodeNormal(const glm::vec3& normal, std::int16_t into[2]) {
    const double sum = std::abs(double{normal.x}) + std::abs(double{normal.y}) + std::abs(double{normal.z});
    if (!(sum > 0.0) || !std::isfinite(sum)) {
        into[0] = into[1] = 0;
        return;
    }
    double x = normal.x / sum;
    double y = normal.y / sum;
    if (normal.z < 0.0f) {
        const double unfoldedX = x;
        x = (1.0 - std::abs(y)) * (unfoldedX >= 0.0 ? 1.0 : -1.0);
        y = (1.0 - std::abs(unfoldedX)) * (y >= 0.0 ? 1.0 : -1.0);
    }
    into[0] = toSnorm16(x);
    into[1] = toSnorm16(y);
}

std::uint32_t mipLevelCount(std::uint32_t width, std::uint32_t height) {
    std::uint32_t levels = 0;
    if (width == 0 || height == 0) return 0;
    for (std::uint32_t side = std::max(width, height); side > 0; side >>= 1) ++levels;
    return levels;
}

std::uint64_t mippedBytes(std::uint32_t width, std::uint32_t height) {
    std::uint64_t bytes = 0;
    for (std::uint32_t level = 0; level < mipLevelCount(width, height); ++level) {
        bytes += std::uint64_t{std::max(1u, width >> level)} * std::max(1u, height >> level) * 4;
    }
    return bytes;
}

std::uint64_t residentBytes(std::uint32_t vertices, std::uint32_t triangles, std::uint32_t textureWidth,
                            std::uint32_t textureHeight) {
    return std::uint64_t{vertices} * sizeof(GpuVertex) +
           std::uint64_t{triangles} * 3 * sizeof(std::uint32_t) + mippedBytes(textureWidth, textureHeight);
}

std::uint32_t atlasSide(std::uint32_t side) {
    std::uint64_t power = 4;
    while (power < side) power *= 2;
    const std::uint64_t between = power / 4 * 3;
    return static_cast<std::uint32_t>(power > 4 && between >= side ? between : power);
}

}  // namespace fb
