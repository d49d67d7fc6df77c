#include "build/least_squares.h"

#include <cmath>
#include <numeric>

namespace fb {
namespace {

constexpr double kDamping = 0.02;  // of the mean weight on the diagonal
constexpr int kMostSteps = 50;
constexpr double kEnough = 1e-6;  // of the squared residual at the start

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

std::vector<double> LeastSquares::solve(std::size_t unknowns) const {
    std::vector<double> x(unknowns, 0.0), gradient(unknowns, 0.0), diagonal(unknowns, 0.0);
    for (const Row& row : rows) {
        for (int k = 0; k < 3; ++k) {
            gradient[row.unknowns[k]] += row.weight * row.factors[k] * row.value;
            diagonal[row.unknowns[k]] += row.weight * row.factors[k] * row.factors[k];
        }
    }
    const double total = std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
    if (total == 0.0) return x;
    const double damping = kDamping * total / static_cast<double>(unknowns);
    std::vector<double> direction = gradient, image(unknowns);
    double squared = dot(gradient, gradient);
    const double enough = kEnough * squared;
    for (int step = 0; step < kMostSteps && squared > enough; ++step) {
        for (std::size_t i = 0; i < unknowns; ++i) image[i] = damping * direction[i];
        for (const Row& row : rows) {
            double along = 0.0;
            for (int k = 0; k < 3; ++k) along += row.factors[k] * direction[row.unknowns[k]];
            for (int k = 0; k < 3; ++k) image[row.unknowns[k]] += row.weight * row.factors[k] * along;
        }
        const double length = squared / dot(direction, image);
        for (std::size_t i = 0; i < unknowns; ++i) {
            x[i] += length * direction[i];
            gradient[i] -= length * image[i];
        }
        const double next = dot(gradient, gradient);
        for (std::size_t i = 0; i < unknowns; ++i) direction[i] = gradient[i] + next / squared * direction[i];
        squared = next;
    }
    return x;
}

}  // namespace fb
