// Known values: the empty input, "a" and "abc" from the published test vectors of XXH3-64 with seed 0.
#include "base/hash.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/random.h"

namespace fb {
namespace {

TEST(HashBytes, GivesTheKnownValuesOfXxh3) {
    EXPECT_EQ(hashBytes("", 0), 0x2d06800538d394c2ull);
    EXPECT_EQ(hashBytes("a", 1), 0xe6c632b61e964e1full);
    EXPECT_EQ(hashBytes("abc", 3), 0x78af5f94892f3950ull);
}

TEST(HashText, IsSixteenLowerCaseDigitsWithLeadingZeros) {
    EXPECT_EQ(hashText(0), "0000000000000000");
    EXPECT_EQ(hashText(0xABCDEFull), "0000000000abcdef");
    EXPECT_EQ(hashText(~0ull), "ffffffffffffffff");
}

TEST(Hasher, GivesTheSameValueHoweverTheBytesAreCut) {
    std::string bytes;
    Random random(7);
    for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(random.index(256));
    const std::uint64_t whole = hashBytes(bytes.data(), bytes.size());
    for (std::size_t step : {1u, 7u, 240u, 241u, 1024u, 4999u}) {
        Hasher hasher;
        for (std::size_t at = 0; at < bytes.size(); at += step) {
            hasher.bytes(bytes.data() + at, std::min(step, bytes.size() - at));
        }
        EXPECT_EQ(hasher.digest(), whole) << "in pieces of " << step;
    }
}

TEST(Hasher, WritesNumbersAsLittleEndianBytes) {
    const unsigned char one[8] = {0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01};
    EXPECT_EQ(Hasher().number(std::uint64_t{0x0102030405060708}).digest(), hashBytes(one, 8));
    const unsigned char half[8] = {0, 0, 0, 0, 0, 0, 0xe0, 0x3f};  // 0.5 = 0x3fe0000000000000
    EXPECT_EQ(Hasher().number(0.5).digest(), hashBytes(half, 8));
}

TEST(Hasher, TakesMinusZeroForZeroAndNothingElseForIt) {
    EXPECT_EQ(Hasher().number(-0.0).digest(), Hasher().number(0.0).digest());
    EXPECT_NE(Hasher().number(std::numeric_limits<double>::denorm_min()).digest(),
              Hasher().number(0.0).digest());
}

TEST(Hasher, TellsWhereOneTextEndsAndTheNextBegins) {
    EXPECT_NE(Hasher().text("ab").text("c").digest(), Hasher().text("a").text("bc").digest());
    EXPECT_NE(Hasher().text("").text("a").digest(), Hasher().text("a").text("").digest());
}

TEST(Hasher, StartsAgainAfterReset) {
    Hasher hasher;
    hasher.text("something before");
    hasher.reset();
    EXPECT_EQ(hasher.digest(), hashBytes("", 0));
    EXPECT_EQ(hasher.bytes("abc", 3).digest(), 0x78af5f94892f3950ull);
    EXPECT_EQ(hasher.digest(), 0x78af5f94892f3950ull);  // reading it changes nothing
}

}  // namespace
}  // namespace fb
