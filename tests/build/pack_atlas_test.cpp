#include "build/pack_atlas.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/random.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

RC_GTEST_PROP(PackAtlas, KeepsChartsApartInsideAnAtlasOfTheClasses, (std::uint64_t seed)) {
    Random random(seed);
    std::vector<Chart> charts(1 + random.index(60));
    for (Chart& chart : charts) {
        chart.width = 1 + static_cast<int>(random.index(40));
        chart.height = 1 + static_cast<int>(random.index(random.index(5) == 0 ? 120 : 20));
        chart.aligned = random.index(3) == 0;
    }
    AtlasSize size;
    RC_ASSERT(packAtlas(charts, 1024, size));
    RC_ASSERT(static_cast<int>(atlasSide(static_cast<std::uint32_t>(size.width))) == size.width);
    RC_ASSERT(static_cast<int>(atlasSide(static_cast<std::uint32_t>(size.height))) == size.height);
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const Chart& a = charts[i];
        RC_ASSERT(a.x >= 0);
        RC_ASSERT(a.y >= 0);
        RC_ASSERT(a.x + a.width <= size.width);
        RC_ASSERT(a.y + a.height <= size.height);
        for (std::size_t j = 0; j < i; ++j) {
            const Chart& b = charts[j];
            const int gap = std::max(std::max(b.x - a.x - a.width, a.x - b.x - b.width),
                                     std::max(b.y - a.y - a.height, a.y - b.y - b.height));
            RC_ASSERT(gap >= 2 * kGutter);
        }
    }
}

TEST(PackAtlas, SaysWhenNothingFits) {
    std::vector<Chart> charts(1);
    charts[0].width = 65;
    charts[0].height = 3;
    AtlasSize size;
    EXPECT_FALSE(packAtlas(charts, 64, size));
    charts[0].width = 64;
    ASSERT_TRUE(packAtlas(charts, 64, size));
    EXPECT_EQ(size.width, 64);
    EXPECT_EQ(size.height, 4);
}

}  // namespace
}  // namespace fb
