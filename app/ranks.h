// The processes of `mpirun`, which build one scene together. A process that was started alone is rank 0 of 1 and never
// touches MPI.
#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"

namespace fb {

class Ranks {
  public:
    // Errors: started by mpirun, but this program was built without MPI.
    [[nodiscard]] static Result<Ranks> start();
    ~Ranks();  // waits for the others
    Ranks(Ranks&& other) noexcept;
    Ranks& operator=(Ranks&&) = delete;

    [[nodiscard]] std::uint32_t index() const { return index_; }
    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] bool isFirst() const { return index_ == 0; }

    // Each waits for all. True when every rank says true.
    [[nodiscard]] bool agree(bool mine) const;
    [[nodiscard]] std::uint64_t sumOf(std::uint64_t mine) const;
    // Whether every rank has the same number.
    [[nodiscard]] bool haveSame(std::uint64_t mine) const;

  private:
    Ranks() = default;

    std::uint32_t index_ = 0, count_ = 1;
    bool isStarted_ = false;
};

}  // namespace fb
