// Finds indices by the hash of what they stand for: open addressing, the keys stay in the caller's own
// arrays. Used where a block's vertices, edges and positions are made unique; the order of insertion never
// matters to what is found, and nothing iterates over the table.
#pragma once

#include <cstdint>
#include <vector>

namespace fb {

[[nodiscard]] inline std::uint64_t mixBits(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

class HashIndex {
  public:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    void reserve(std::size_t count) {
        std::size_t slots = 16;
        while (slots < count * 2) slots *= 2;
        if (slots > slots_.size()) rehash(slots);
    }
    void clear() {
        slots_.clear();
        count_ = 0;
    }
    [[nodiscard]] bool empty() const { return count_ == 0; }

    // The index whose key `equals(index)`, or kNone.
    template <class Equals>
    [[nodiscard]] std::uint32_t find(std::uint64_t hash, Equals&& equals) const {
        if (slots_.empty()) return kNone;
        const std::uint32_t tag = static_cast<std::uint32_t>(hash);
        for (std::size_t at = tag & mask();; at = (at + 1) & mask()) {
            if (slots_[at].index == kNone) return kNone;
            if (slots_[at].tag == tag && equals(slots_[at].index)) return slots_[at].index;
        }
    }
    // The key must not be there yet.
    void insert(std::uint64_t hash, std::uint32_t index) {
        if (count_ * 2 >= slots_.size()) rehash(slots_.empty() ? 16 : slots_.size() * 2);
        place({static_cast<std::uint32_t>(hash), index});
        ++count_;
    }

  private:
    struct Slot {
        std::uint32_t tag = 0;
        std::uint32_t index = kNone;
    };

    [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
    void place(Slot slot) {
        std::size_t at = slot.tag & mask();
        while (slots_[at].index != kNone) at = (at + 1) & mask();
        slots_[at] = slot;
    }
    void rehash(std::size_t slots) {
        std::vector<Slot> old(slots);
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.index != kNone) place(slot);
        }
    }

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
};

}  // namespace fb
