// Numbers different keys in the order in which they first appear: the base of welding, of duplicate search
// and of turning corners into vertices. Keys are fixed numbers of 32-bit words; the result depends on their
// order alone. Open addressing over a power of two, at most half full.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/hash.h"

namespace fb {

template <std::size_t Words>
class FirstAppearance {
  public:
    using Key = std::array<std::uint32_t, Words>;

    explicit FirstAppearance(std::size_t expectedKeys) {
        std::size_t slots = 16;
        while (slots < 2 * expectedKeys) slots *= 2;
        slots_.assign(slots, kEmpty);
        keys_.reserve(expectedKeys);
    }

    // The number of `key`; it was seen for the first time if that is the size() before the call.
    std::uint32_t numberOf(const Key& key) {
        std::size_t slot = slotOf(key);
        while (slots_[slot] != kEmpty) {
            if (keys_[slots_[slot]] == key) return slots_[slot];
            slot = (slot + 1) & (slots_.size() - 1);
        }
        const auto number = static_cast<std::uint32_t>(keys_.size());
        slots_[slot] = number;
        keys_.push_back(key);
        if (2 * keys_.size() > slots_.size()) grow();
        return number;
    }

    [[nodiscard]] std::size_t size() const { return keys_.size(); }

  private:
    static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};

    std::size_t slotOf(const Key& key) const {
        return hashBytes(key.data(), sizeof(Key)) & (slots_.size() - 1);
    }

    void grow() {
        slots_.assign(2 * slots_.size(), kEmpty);
        for (std::uint32_t number = 0; number < keys_.size(); ++number) {
            std::size_t slot = slotOf(keys_[number]);
            while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = number;
        }
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Key> keys_;
};

}  // namespace fb
