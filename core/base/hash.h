// 64-bit XXH3 checksums: of one buffer, or streamed field by field. Numbers are hashed as little-endian bytes, so
// that a hash means the same on every machine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace fb {

[[nodiscard]] std::uint64_t hashBytes(const void* data, std::size_t sizeBytes);
[[nodiscard]] std::string hashText(std::uint64_t hash);  // 16 lower-case hexadecimal digits

class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& bytes(const void* data, std::size_t sizeBytes);
    Hasher& text(std::string_view text);  // length first, so that "ab","c" differs from "a","bc"
    Hasher& number(std::uint64_t value);
    Hasher& number(double value);  // -0 hashes as 0
    [[nodiscard]] std::uint64_t digest() const;
    void reset();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fb
