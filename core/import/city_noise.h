// Value noise on integer lattices: the irregularity of every surface and texture of the procedural city.
// Only integer hashes and + - * on floating point, so that the same seed gives the same bits on every
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fb::city {

// Mixes to 32 well distributed bits (multipliers of the lowbias32 hash, C. Wellons 2018).
[[nodiscard]] inline std::uint32_t mixBits(std::uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return h;
}

[[nodiscard]] inline std::uint32_t latticeHash(std::uint32_t seed, std::int32_t x, std::int32_t y) {
    const auto ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
    return mixBits(seed + ux * 0x9e3779b1u + (uy ^ seed) * 0x85ebca77u);
}

// In [-1, 1].
[[nodiscard]] inline float signedUnit(std::uint32_t hash) {
    return static_cast<float>(static_cast<std::int32_t>(hash)) * 0x1p-31f;
}

// In [0, 1], from the upper 24 bits.
[[nodiscard]] inline float unit(std::uint32_t hash) {
    return static_cast<float>(hash >> 8) * 0x1p-24f;
}

// Smooth noise in [-1, 1] at one point; features are `period` wide.
[[nodiscard]] double smoothNoise(std::uint32_t seed, double x, double y, double period);

// One octave of smooth noise over a picture, row by row: the columns' places are given once, then rows come
// in any order (cheapest when neighbours follow each other). Values of lattice points are hashed once a
// lattice row.
class NoiseOctave {
  public:
    NoiseOctave(std::span<const float> columns, double period, std::uint32_t seed);

    // out[i] += amplitude * noise(columns[i], y)
    void addRow(double y, float amplitude, std::span<float> out);

  private:
    void hashRow(std::int32_t latticeY, std::vector<float>& values) const;

    double period_;
    std::uint32_t seed_;
    std::int32_t firstX_ = 0;
    std::vector<std::uint32_t> cell_;  // lattice column left of each column, counted from firstX_
    std::vector<float> weight_;        // smoothed place inside that cell, 0 to 1
    std::vector<float> lower_, upper_, line_;
    std::int32_t lowerY_ = 0;
    bool filled_ = false;
};

}  // namespace fb::city
