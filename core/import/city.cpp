#include "import/city.h"

#include <array>
#include <cstdio>

#include "base/check.h"
#include "base/hash.h"
#include "import/city_block.h"

namespace fb {
namespace {

constexpr std::uint64_t kGeneratorVersion = 4;  // raise it when the same options give another city

constexpr std::uint64_t kHillsVersion = 1;      // the same for cities on hills

constexpr std::uint64_t kMostBlocks = 10000;
constexpr std::uint64_t kLeastTriangles = 1000, kMostTriangles = 2000000;  // a block
constexpr std::uint64_t kLeastTexels = 8192, kMostTexels = 16000000;       // a block

class CitySource final : public BlockSource {
  public:
    CitySource(city::CityPlan&& plan, std::vector<city::UnitBudget>&& budgets, const CityOptions& options)
        : plan_(std::move(plan)), budgets_(std::move(budgets)) {
        info_.name = "city";
        const city::Rect& ground = plan_.ground;
        info_.bounds.grow(glm::dvec3(ground.x0, -0.2, ground.z0));
        info_.bounds.grow(glm::dvec3(ground.x1, plan_.highestTop, ground.z1));
        if (options.terrain) {
            country_ = city::makeCountry(plan_);
            info_.bounds.grow(glm::dvec3(ground.x0, country_->info().lowestMetres, ground.z0));
        }
        Hasher hash;
        hash.text("city").number(kGeneratorVersion).number(options.blocks).number(options.triangles);
        hash.number(options.texels).number(options.seed);
        if (country_) hash.text("terrain").number(kHillsVersion).number(country_->info().sourceHash);
        info_.sourceHash = hash.digest();
        info_.walks.push_back(city::planWalk(plan_));
        for (glm::dvec3& p : info_.walks.back().points) p.y += plan_.hills.heightAt(p.x, p.z);
        for (const city::UnitBudget& budget : budgets_) info_.report.sourceTriangles += budget.triangles;
        info_.report.keptTriangles = info_.report.sourceTriangles;
    }

    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return plan_.units.size(); }
    [[nodiscard]] Result<SourceBlock> load(std::size_t block) const override {
        FB_CHECK(block < plan_.units.size());
        std::array<char, 24> name{};
        std::snprintf(name.data(), name.size(), "block %zu", block + 1);
        return city::makeBlock(plan_, plan_.units[block], budgets_[block], name.data());
    }

    [[nodiscard]] const TerrainSource* terrain() const override { return country_.get(); }

  private:
    city::CityPlan plan_;
    std::vector<city::UnitBudget> budgets_;
    std::unique_ptr<TerrainSource> country_;  // null without --terrain
    SourceInfo info_;
};

std::string countText(std::uint64_t count) {
    return std::to_string(count);
}

Result<void> checkOptions(const CityOptions& options) {
    if (options.blocks == 0 || options.blocks > kMostBlocks) {
        return usageFailure("--blocks", countText(options.blocks) + " blocks cannot be made",
                            "1 to " + countText(kMostBlocks));
    }
    const auto check = [&](const char* option, const char* what, std::uint64_t value, std::uint64_t least,
                           std::uint64_t most) -> Result<void> {
        const std::uint64_t low = least * options.blocks, high = most * options.blocks;
        if (value >= low && value <= high) return {};
        return usageFailure(
            option, countText(value) + " " + what + " do not fit " + countText(options.blocks) + " blocks",
            countText(low) + " to " + countText(high));
    };
    if (auto fits = check("--triangles", "triangles", options.triangles, kLeastTriangles, kMostTriangles);
        !fits)
        return fits;
    return check("--texels", "texels", options.texels, kLeastTexels, kMostTexels);
}

}  // namespace

Result<std::unique_ptr<BlockSource>> makeCity(const CityOptions& options) {
    if (auto checked = checkOptions(options); !checked) return passOn(checked);
    city::CityPlan plan = city::makePlan(options);
    std::vector<city::UnitBudget> budgets = city::shareBudget(plan, options);
    return std::make_unique<CitySource>(std::move(plan), std::move(budgets), options);
}

}  // namespace fb
