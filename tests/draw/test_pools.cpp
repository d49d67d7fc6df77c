// Where nodes lie on the GPU must not show: pages, classes, staging, nodes that come and go.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <epoxy/gl.h>

#include <map>
#include <numeric>
#include <optional>

#include "draw/allocate_ranges.h"
#include "draw/draw_world.h"
#include "draw/texture_pages.h"
#include "draw/upload_staging.h"

namespace fb::draw_test {

// Against an array of flags in which the first long enough run of free units is looked for.
RC_GTEST_PROP(RangeAllocator, HandsOutTheFirstFreeRangeAndJoinsWhatComesBack, ()) {
    const auto units = *rc::gen::inRange<std::uint32_t>(1, 60);
    RangeAllocator ranges(units);
    std::vector<bool> used(units, false);
    std::map<std::uint32_t, std::uint32_t> held;
    const auto steps = *rc::gen::container<std::vector<std::pair<bool, std::uint32_t>>>(
        rc::gen::pair(rc::gen::arbitrary<bool>(), rc::gen::inRange<std::uint32_t>(1, 20)));
    for (const auto& [give, number] : steps) {
        if (give) {
            std::optional<std::uint32_t> expected;
            for (std::uint32_t at = 0; !expected && at + number <= units; ++at) {
                bool free = true;
                for (std::uint32_t i = at; i < at + number; ++i) free = free && !used[i];
                if (free) expected = at;
            }
            const auto got = ranges.allocate(number);
            RC_ASSERT(got == expected);
            if (!got) continue;
            held[*got] = number;
            std::fill_n(used.begin() + *got, number, true);
        } else if (!held.empty()) {
            auto chosen = std::next(held.begin(), number % held.size());
            ranges.release(chosen->first, chosen->second);
            std::fill_n(used.begin() + chosen->first, chosen->second, false);
            held.erase(chosen);
        }
        std::uint32_t inUse = 0, runs = 0;
        for (std::uint32_t i = 0; i < units; ++i) {
            inUse += used[i] ? 1 : 0;
            runs += !used[i] && (i == 0 || used[i - 1]) ? 1 : 0;
        }
        RC_ASSERT(ranges.usedUnits() == inUse);
        RC_ASSERT(ranges.freeRanges() == runs);
        RC_ASSERT(ranges.empty() == (inUse == 0));
    }
}

TEST(RangeAllocatorDeathTest, StopsWhenARangeComesBackTwice) {
    RangeAllocator ranges(10);
    ASSERT_EQ(ranges.allocate(4), 0u);
    ASSERT_EQ(ranges.allocate(4), 4u);
    ranges.release(0, 4);
    EXPECT_DEATH(ranges.release(0, 4), "against");
    EXPECT_DEATH(ranges.release(6, 5), "against");
}

namespace {

// Thirty tilted rectangles, half of them textured in three sizes, some with holes.
World mixedWorld(bool oneBlock) {
    World world;
    for (int i = 0; i < 30; ++i) {
        const float z = -8.0f - static_cast<float>(i % 7), x = static_cast<float>(i) * 0.5f - 9.0f;
        DecodedNode node;
        const std::array<glm::vec3, 4> corners = {
            glm::vec3{x, 5, z}, {x + 4, 5.5f, z - 1}, {x + 5, -5, z}, {x, -6, z + 1}};
        if (i % 2 == 0) {
            const int side = 8 << (i % 3);
            addTexturedQuad(node, corners);
            setTexture(node, side, side / 2, manyColours(side, side / 2));
            for (std::size_t k = 3; i % 4 == 0 && k < node.texels.size(); k += 20) node.texels[k] = 0;
            node.flags.alphaMask = i % 4 == 0;
        }
        addQuad(node,
                {corners[3], corners[2], corners[1] - glm::vec3(0, 8, 0), corners[0] - glm::vec3(0, 8, 0)},
                {static_cast<std::uint8_t>(i * 8), 120, 60});
        world.add(std::move(node));
        if (oneBlock) world.hierarchy.block.back() = 0;
    }
    return world;
}

}  // namespace

TEST_F(DrawTest, ShowsTheSameWhateverThePagesAndBlocks) {
    effects[Effect::texturing] = effects[Effect::lighting] = true;
    settings.wireframe = settings.boxes = true;
    const View view = viewAlongZ({0, 0, 1}, 120, 90);
    const World world = mixedWorld(false);
    world.uploadAll(*renderer);
    const Image expected = picture(world, view);
    // Texture sizes 8 x 4 and 32 x 16 with holes, 16 x 8 without and so on: five programs and pages; no more,
    // for three sizes with and without mask and the untextured, all in one mesh page, once for the wireframe.
    const std::uint32_t fewMultiDraws = counters.multiDraws;
    EXPECT_LE(fewMultiDraws, 2u * 7u);

    RendererOptions tiny;
    tiny.meshPageBytes = 400;
    tiny.smallestTexturePageBytes = 1;
    tiny.largestTexturePageBytes = 1;
    remake(tiny);
    world.uploadAll(*renderer);
    EXPECT_EQ(picture(world, view).pixels, expected.pixels);
    EXPECT_GT(counters.multiDraws, 60u);

    const World oneBlock = mixedWorld(true);
    EXPECT_EQ(pictureWith({}, oneBlock, view, settings, effects).pixels, expected.pixels);

    for (const std::size_t ringBytes :
         {std::size_t{1}, std::size_t{700}, std::size_t{4096}, std::size_t{1} << 20}) {
        RendererOptions staged;
        staged.uploadRingBytes = ringBytes;
        EXPECT_EQ(pictureWith(staged, world, view, settings, effects).pixels, expected.pixels) << ringBytes;
    }
}

// Nodes come, are replaced and go in any order. Node n shows one square of the picture in a colour that says
// which content it holds; memory is the sum of what is held, and nothing when all are gone.
TEST_F(DrawTest, KeepsThePoolsConsistentWhateverComesAndGoes) {
    constexpr int kNodes = 16;
    struct Held {
        Rgb colour;
        std::uint64_t meshBytes, textureBytes;
    };
    const auto content = [](int node, int kind, const Rgb& colour) {
        const auto x = static_cast<float>(node % 4 * 4 - 8), y = static_cast<float>(node / 4 * 4 - 8);
        DecodedNode made;
        if (kind % 4 != 0) {
            addTexturedQuad(made, rectangle(x, y, x + 4, y + 4, -8));
            const int width = 4 << (kind % 3), height = 4 << (kind / 3 % 2);
            std::vector<std::uint8_t> texels;
            for (int i = 0; i < width * height; ++i) {
                texels.insert(texels.end(), {colour[0], colour[1], colour[2], 255});
            }
            setTexture(made, width, height, texels);
        } else {
            for (int i = 0; i <= kind; ++i) addQuad(made, rectangle(x, y, x + 4, y + 4, -8), colour);
        }
        return made;
    };
    World world;
    for (int node = 0; node < kNodes; ++node) world.add(content(node, 0, kRed));
    effects[Effect::texturing] = true;
    const View view = viewAlongZ({}, 16, 16);

    RendererOptions tiny;
    tiny.meshPageBytes = 1500;
    tiny.smallestTexturePageBytes = 300;
    tiny.largestTexturePageBytes = 2000;
    RendererOptions staged = tiny;
    staged.uploadRingBytes = 1000;
    for (const RendererOptions& options : {tiny, staged}) {
        remake(options);
        EXPECT_TRUE(rc::check("pools against a map", [&] {
            std::map<int, Held> held;
            const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
                rc::gen::pair(rc::gen::inRange(0, kNodes), rc::gen::inRange(-12, 24)));
            int number = 0;
            for (const auto& [node, kind] : steps) {
                if (kind < 0) {
                    renderer->release(static_cast<NodeId>(node));
                    held.erase(node);
                } else {
                    ++number;
                    const Rgb colour{static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(node * 15),
                                     255};
                    const DecodedNode made = content(node, kind, colour);
                    RC_ASSERT(renderer->upload(static_cast<NodeId>(node), made).has_value());
                    held[node] = {colour, made.vertices.size() * 24 + made.indices.size() * 4,
                                  made.texels.size()};
                }
                std::uint64_t meshBytes = 0, textureBytes = 0;
                for (const auto& [n, h] : held) {
                    meshBytes += h.meshBytes;
                    textureBytes += h.textureBytes;
                }
                const GpuMemory memory = renderer->memory();
                RC_ASSERT(memory.meshBytes == meshBytes);
                RC_ASSERT(memory.textureBytes == textureBytes);
                RC_ASSERT(memory.allocatedMeshBytes >= meshBytes);
                RC_ASSERT(memory.allocatedTextureBytes >= textureBytes);
                RC_ASSERT((memory.allocatedTextureBytes == 0) == (textureBytes == 0));
            }
            renderer->draw({world.hierarchy, world.front, view, settings, effects}, 1);
            const Image image = renderer->readPicture();
            for (int node = 0; node < kNodes; ++node) {
                const Rgb shown = pixel(image, node % 4 * 4 + 1, 14 - node / 4 * 4);
                const auto holds = held.find(node);
                if (holds != held.end()) {
                    RC_ASSERT(shown == holds->second.colour);
                } else {
                    RC_ASSERT(shown[2] != 255);
                }
            }
            for (int node = 0; node < kNodes; ++node) renderer->release(static_cast<NodeId>(node));
            const GpuMemory memory = renderer->memory();
            RC_ASSERT(memory.meshBytes + memory.textureBytes + memory.allocatedMeshBytes +
                          memory.allocatedTextureBytes ==
                      0u);
        }));
    }
}

// A class of one node takes one small page; pages of a class double up to the bound. 64 x 64 with mips:
// 21,844 bytes.
TEST_F(DrawTest, GrowsTheTexturePagesOfAClassByDoubling) {
    constexpr std::uint64_t kLayer = 21'844;
    TexturePages pages(2 * kLayer, 8 * kLayer + 100, false);
    std::vector<TextureSlot> slots;
    std::vector<std::uint64_t> allocatedLayers;
    for (int i = 0; i < 25; ++i) {
        auto slot = pages.allocate(64, 64);
        ASSERT_TRUE(slot);
        slots.push_back(*slot);
        allocatedLayers.push_back(pages.allocatedBytes() / kLayer);
    }
    const std::vector<std::uint64_t> expected = {2,  2,  4,  4,  8,  8,  8,  8,  16, 16, 16, 16, 16,
                                                 16, 16, 16, 24, 24, 24, 24, 24, 24, 24, 24, 32};
    EXPECT_EQ(allocatedLayers, expected);
    // A larger texture than the bound gets a page for itself alone.
    const std::uint64_t before = pages.allocatedBytes();
    auto large = pages.allocate(1024, 512);
    ASSERT_TRUE(large);
    EXPECT_EQ(pages.allocatedBytes() - before, mippedBytes(1024, 512));
    pages.release(*large);
    for (const TextureSlot& slot : slots) pages.release(slot);
    EXPECT_EQ(pages.allocatedBytes(), 0u);
    EXPECT_EQ(pages.pageCount(), 0u);
}

// Copies of many sizes through a ring that holds few of them, read back.
TEST_F(DrawTest, CopiesEveryByteThroughASmallRing) {
    for (const std::size_t ringBytes :
         {std::size_t{0}, std::size_t{64}, std::size_t{1000}, std::size_t{4096}}) {
        auto staging = UploadStaging::create(ringBytes);
        ASSERT_TRUE(staging);
        std::vector<std::uint8_t> expected(200'000), got(expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            expected[i] = static_cast<std::uint8_t>(i * i / 7 + i);
        const GlBuffer buffer = GlBuffer::make();
        glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(got.size()), nullptr,
                             GL_DYNAMIC_STORAGE_BIT);
        std::size_t at = 0;
        for (std::size_t size = 0; at < expected.size(); size = (size * 5 + 4) % 1013) {
            const std::size_t bytes = std::min(size, expected.size() - at);
            staging->copyToBuffer(buffer.name(), at, std::span(expected).subspan(at, bytes));
            at += bytes;
        }
        glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(got.size()), got.data());
        EXPECT_TRUE(got == expected) << ringBytes;
    }
}

}  // namespace fb::draw_test
