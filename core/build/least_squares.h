// Sparse least squares with up to three unknowns a row, solved by conjugate gradients (Hestenes and Stiefel 1952, on the
// normal equations). Goes to fit_surface.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace fb {

struct LeastSquares {
    // weight * (value - sum of factors * unknowns)^2
    struct Row {
        glm::uvec3 unknowns{0u};
        glm::dvec3 factors{0.0};
        double value = 0.0, weight = 1.0;
    };
    std::vector<Row> rows;

    // Unknowns that no row holds fast stay near 0: each is weighed a little by itself too.
    [[nodiscard]] std::vector<double> solve(std::size_t unknowns) const;
};

}  // namespace fb
