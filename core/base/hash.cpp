#include "base/hash.h"

#include <array>
#include <bit>
#include <cstdio>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace fb {

std::uint64_t hashBytes(const void* data, std::size_t sizeBytes) { return XXH3_64bits(data, sizeBytes); }

std::string hashText(std::uint64_t hash) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
    return text.data();
}

struct Hasher::State {
    XXH3_state_t xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>()) { reset(); }
Hasher::~Hasher() = default;

void Hasher::reset() { XXH3_64bits_reset(&state_->xxh); }

Hasher& Hasher::bytes(const void* data, std::size_t sizeBytes) {
    XXH3_64bits_update(&state_->xxh, data, sizeBytes);
    return *this;
}

Hasher& Hasher::text(std::string_view text) { return number(std::uint64_t{text.size()}).bytes(text.data(), text.size()); }

Hasher& Hasher::number(std::uint64_t value) {
    std::array<unsigned char, 8> little{};
    for (unsigned char& byte : little) {
        byte = static_cast<unsigned char>(value & 0xff);
        value >>= 8;
    }
    return bytes(little.data(), little.size());
}

Hasher& Hasher::number(double value) { return number(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value)); }

std::uint64_t Hasher::digest() const { return XXH3_64bits_digest(&state_->xxh); }

}  // namespace fb
