// Seeded random numbers that are the same on every machine (the distributions of <random> are not).
// Generator: SplitMix64 (Steele, Lea, Flood 2014), which passes BigCrush and has no bad seeds.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace fb {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    // In [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    // In [0, count).
    std::uint64_t index(std::uint64_t count) { return count == 0 ? 0 : bits() % count; }
    // Mean 0, standard deviation 1. Box and Muller; std::log and std::cos may differ in the last place between C
    // libraries, so nothing that is hashed across machines may depend on more than a rounded result.
    double normal() {
        const double u = 1.0 - uniform();
        const double v = uniform();
        return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
    }
    // A generator for part number `part` that does not depend on how far this one has run.
    [[nodiscard]] static Random forPart(std::uint64_t seed, std::uint64_t part) {
        Random mix(seed ^ (part * 0xd1342543de82ef95ull + 0x632be59bd9b4e019ull));
        return Random(mix.bits());
    }

  private:
    std::uint64_t state_;
};

}  // namespace fb
