#include "copied_source.h"

namespace fb::bench {
namespace {

constexpr double kGap = 0.1;  // between copies, in sizes of the original

class CopiedSource final : public BlockSource {
  public:
    CopiedSource(std::unique_ptr<BlockSource> original, std::size_t side)
        : original_(std::move(original)), side_(side), info_(original_->info()) {
        const glm::dvec3 size = info_.bounds.size() * (1.0 + kGap);
        along_ = {size.x, 0.0, 0.0};
        across_ = info_.up == UpAxis::y ? glm::dvec3(0.0, 0.0, size.z) : glm::dvec3(0.0, size.y, 0.0);
        info_.bounds.grow(info_.bounds.max + shiftOf(side * side - 1));
        info_.sourceHash += side;
        info_.walks.clear();
    }

    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return original_->blockCount() * side_ * side_; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t block) const override {
        const std::size_t copy = block / original_->blockCount();
        Result<SourceBlock> loaded = original_->load(block % original_->blockCount());
        if (!loaded) return loaded;
        loaded->name += ", copy " + std::to_string(copy + 1);
        for (glm::dvec3& p : loaded->mesh.positions) p += shiftOf(copy);
        return loaded;
    }

  private:
    [[nodiscard]] glm::dvec3 shiftOf(std::size_t copy) const {
        return static_cast<double>(copy % side_) * along_ + static_cast<double>(copy / side_) * across_;
    }

    std::unique_ptr<BlockSource> original_;
    std::size_t side_;
    SourceInfo info_;
    glm::dvec3 along_{0.0}, across_{0.0};
};

}  // namespace

std::unique_ptr<BlockSource> copySource(std::unique_ptr<BlockSource> original, std::size_t side) {
    return std::make_unique<CopiedSource>(std::move(original), side);
}

}  // namespace fb::bench
