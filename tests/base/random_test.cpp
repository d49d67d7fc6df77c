// The sequences for the seeds 0 and 1234567 are those published with SplitMix64's reference implementations.
#include "base/random.h"

#include <gtest/gtest.h>

#include <set>

namespace fb {
namespace {

TEST(Random, GivesTheKnownSequenceOfSplitMix64) {
    Random zero(0);
    for (std::uint64_t expected : {0xe220a8397b1dcdafull, 0x6e789e6aa1b965f4ull, 0x06c45d188009454full,
                                   0xf88bb8a8724c81ecull, 0x1b39896a51a8749bull}) {
        EXPECT_EQ(zero.bits(), expected);
    }
    Random other(1234567);
    for (std::uint64_t expected : {6457827717110365317ull, 3203168211198807973ull, 9817491932198370423ull,
                                   4593380528125082431ull, 16408922859458223821ull}) {
        EXPECT_EQ(other.bits(), expected);
    }
}

TEST(Random, UniformIsTheUpper53BitsOfTheSequence) {
    Random random(0);
    // 0xe220a8397b1dcdaf >> 11, divided by 2^53.
    EXPECT_EQ(random.uniform(), 0x1c4415072f63b9p-53);
}

TEST(Random, UniformStaysBelowOneAndFillsTheRange) {
    Random random(3);
    double low = 1.0, high = 0.0, sum = 0.0;
    constexpr int kCount = 100000;
    for (int i = 0; i < kCount; ++i) {
        const double u = random.uniform();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        low = std::min(low, u);
        high = std::max(high, u);
        sum += u;
    }
    EXPECT_LT(low, 1e-3);
    EXPECT_GT(high, 1.0 - 1e-3);
    EXPECT_NEAR(sum / kCount, 0.5, 5.0 * 0.2887 / std::sqrt(kCount));  // five standard errors
}

TEST(Random, IndexReachesEveryValueBelowTheCountAndIsZeroForNone) {
    Random random(5);
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 200; ++i) seen.insert(random.index(7));
    EXPECT_EQ(seen, (std::set<std::uint64_t>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(random.index(0), 0u);
    EXPECT_EQ(random.index(1), 0u);
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
    Random random(11);
    constexpr int kCount = 100000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kCount; ++i) {
        const double x = random.normal();
        ASSERT_TRUE(std::isfinite(x));
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
    EXPECT_NEAR(squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
}

TEST(Random, PartsDependOnSeedAndPartAloneAndDiffer) {
    std::set<std::uint64_t> firsts;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (std::uint64_t part = 0; part < 50; ++part) {
            Random a = Random::forPart(seed, part);
            Random b = Random::forPart(seed, part);
            const std::uint64_t first = a.bits();
            EXPECT_EQ(first, b.bits());
            firsts.insert(first);
        }
    }
    EXPECT_EQ(firsts.size(), 1000u);
}

}  // namespace
}  // namespace fb
