// The same seed gives the same bytes, whatever the order of loading and however many threads load.
#include <set>
#include <thread>

#include "city/load_city.h"

namespace fb {
namespace {

std::vector<std::uint64_t> hashesInOrder(const BlockSource& city, bool backwards) {
    std::vector<std::uint64_t> hashes(city.blockCount());
    for (std::size_t k = 0; k < hashes.size(); ++k) {
        const std::size_t i = backwards ? hashes.size() - 1 - k : k;
        hashes[i] = test::hashOf(*city.load(i));
    }
    return hashes;
}

TEST(CityDeterminism, BlocksAreTheSameInAnyOrderOfLoadingAndFromAnySource) {
    const auto first = test::cityOf(test::smallCity()), second = test::cityOf(test::smallCity());
    const auto forwards = hashesInOrder(*first, false);
    EXPECT_EQ(forwards, hashesInOrder(*first, true));
    EXPECT_EQ(forwards, hashesInOrder(*second, true));
    EXPECT_EQ(first->info().sourceHash, second->info().sourceHash);
}

TEST(CityDeterminism, BlocksAreTheSameFromTwoThreads) {
    const auto city = test::cityOf(test::smallCity());
    const auto expected = hashesInOrder(*city, false);
    std::vector<std::uint64_t> forwards, backwards;
    std::thread a([&] { forwards = hashesInOrder(*city, false); });
    std::thread b([&] { backwards = hashesInOrder(*city, true); });
    a.join();
    b.join();
    EXPECT_EQ(forwards, expected);
    EXPECT_EQ(backwards, expected);
}

TEST(CityDeterminism, AnotherSeedGivesOtherBlocksAndAnotherSourceHash) {
    const auto one = test::cityOf(test::smallCity(1)), two = test::cityOf(test::smallCity(2));
    const auto ones = hashesInOrder(*one, false), twos = hashesInOrder(*two, false);
    for (std::size_t i = 0; i < ones.size(); ++i) EXPECT_NE(ones[i], twos[i]) << i;
    EXPECT_NE(one->info().sourceHash, two->info().sourceHash);
}

TEST(CityDeterminism, EveryOptionChangesTheSourceHash) {
    const CityOptions base{4, 16000, 80000, 5};
    std::set<std::uint64_t> hashes{test::cityOf(base)->info().sourceHash};
    for (int option = 0; option < 4; ++option) {
        CityOptions other = base;
        if (option == 0) ++other.blocks;
        if (option == 1) ++other.triangles;
        if (option == 2) ++other.texels;
        if (option == 3) ++other.seed;
        hashes.insert(test::cityOf(other)->info().sourceHash);
    }
    EXPECT_EQ(hashes.size(), 5u);
}

TEST(CityDeterminism, NoTwoTexturesOfACityAreAlike) {
    const auto city = test::cityOf(test::smallCity());
    std::set<std::uint64_t> hashes;
    std::size_t textures = 0;
    for (const SourceBlock& block : test::loadAll(*city)) {
        for (const SourceTexture& texture : block.textures) {
            hashes.insert(hashBytes(texture.image->pixels.data(), texture.image->pixels.size()));
            ++textures;
        }
    }
    EXPECT_EQ(hashes.size(), textures);
}

}  // namespace
}  // namespace fb
