// Where the loader reads payload bytes from: the scene's packs, or a slow or faulty disk made by a test.
// Bytes go to the verifier and decoder of decode_payload.h.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/result.h"
#include "scenefile/scene.h"

namespace fb {

class PayloadSource {
  public:
    virtual ~PayloadSource() = default;
    // Fills `into` from byte `offset` of pack number `pack`. May block; called on loader threads, several at
    // once.
    [[nodiscard]] virtual Result<void> readAt(std::uint32_t pack, std::uint64_t offset,
                                              std::span<std::uint8_t> into) = 0;
};

class ScenePacks final : public PayloadSource {
  public:
    explicit ScenePacks(const Scene& scene) : scene_(scene) {}
    [[nodiscard]] Result<void> readAt(std::uint32_t pack, std::uint64_t offset,
                                      std::span<std::uint8_t> into) override;

  private:
    const Scene& scene_;
};

}  // namespace fb
