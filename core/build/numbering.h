// Numbers given to ids, again and again from the start without clearing a table. For the simplifiers' and the error
// measure's own vertex numbers.
#pragma once

#include <cstdint>
#include <vector>

namespace fb {

class Numbering {
  public:
    explicit Numbering(std::size_t ids) : numbers_(ids, 0), stamps_(ids, 0) {}

    struct Number {
        std::uint32_t value;
        bool isNew;  // the id had none since the last restart
    };

    void restart(std::uint32_t first = 0) {
        ++stamp_;
        next_ = first;
    }
    // The number of `id`: the next one where it has none yet.
    Number take(std::uint32_t id) {
        if (stamps_[id] == stamp_) return {numbers_[id], false};
        stamps_[id] = stamp_;
        numbers_[id] = next_;
        return {next_++, true};
    }
    [[nodiscard]] std::uint32_t next() const { return next_; }

  private:
    std::vector<std::uint32_t> numbers_, stamps_;
    std::uint32_t stamp_ = 0, next_ = 0;
};

}  // namespace fb
