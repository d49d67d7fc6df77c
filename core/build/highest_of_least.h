// The largest value over a triangle of the least of three linear functions. Goes to farthest_from: the
// distance to the nearest of three faces is bounded by it.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <limits>

namespace fb {

// `values`: by function, at the corners. The largest value lies at a corner, where two functions are equal on
// a side, or where all three are (the vertices of a linear programme in two dimensions).
[[nodiscard]] inline float highestOfLeast(const std::array<glm::vec3, 3>& values) {
    const auto leastAt = [&](const glm::vec3& weights) {
        return std::min(
            {glm::dot(values[0], weights), glm::dot(values[1], weights), glm::dot(values[2], weights)});
    };
    float highest = -std::numeric_limits<float>::infinity();
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        highest = std::max(highest, std::min({values[0][i], values[1][i], values[2][i]}));
        for (std::size_t f = 0; f < 3; ++f) {
            const std::size_t g = (f + 1) % 3;
            const float here = values[f][i] - values[g][i], there = values[f][j] - values[g][j];
            if (here * there >= 0.0f) continue;
            glm::vec3 weights(0.0f);
            weights[j] = here / (here - there);
            weights[i] = 1.0f - weights[j];
            highest = std::max(highest, leastAt(weights));
        }
    }
    const glm::vec3 equal = glm::cross(values[0] - values[1], values[1] - values[2]);
    const float sum = equal.x + equal.y + equal.z;
    if (sum != 0.0f && glm::all(glm::greaterThanEqual(equal / sum, glm::vec3(0.0f))))
        highest = std::max(highest, leastAt(equal / sum));
    return highest;
}

}  // namespace fb
