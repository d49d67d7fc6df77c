// Height maps from files: what is read of each format, where it goes, what is refused and in which words.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "import/geo_tags.h"
#include "import/open_terrain.h"
#include "temp_folder.h"

namespace fb::test {
namespace {

template <class T>
std::filesystem::path writeHeights(const std::filesystem::path& file, int width, int height,
                                   OIIO::TypeDesc type, const std::vector<T>& values, int channels = 1) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output);
    OIIO::ImageSpec spec(width, height, channels, type);
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(type, values.data()));
    EXPECT_TRUE(output->close());
    return file;
}

// A TIFF of floats with GeoTIFF tags; by hand, since OpenImageIO writes none.
class GeoTiff {
  public:
    GeoTiff(std::uint32_t width, std::uint32_t height, bool bigEndian) : big_(bigEndian) {
        short_(256, width), short_(257, height), short_(258, 32), short_(259, 1), short_(262, 1);
        short_(277, 1), short_(278, height), short_(339, 3);
    }
    void reals(std::uint16_t tag, const std::vector<double>& values) {
        Entry e{tag, 12, static_cast<std::uint32_t>(values.size()), {}};
        for (const double v : values) put(e.data, v);
        entries_.push_back(e);
    }
    void text(std::uint16_t tag, std::string value) {
        value.push_back('\0');
        entries_.push_back({tag, 2, static_cast<std::uint32_t>(value.size()), {value.begin(), value.end()}});
    }
    void shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) {
        Entry e{tag, 3, static_cast<std::uint32_t>(values.size()), {}};
        for (const std::uint16_t v : values) put(e.data, v);
        entries_.push_back(e);
    }
    std::filesystem::path write(const std::filesystem::path& path, const std::vector<float>& pixels) {
        std::vector<std::uint8_t> data;
        for (const float v : pixels) put(data, v);
        entries_.push_back({273, 4, 1, {}});
        entries_.push_back({279, 4, 1, {}});
        std::sort(entries_.begin(), entries_.end(),
                  [](const Entry& a, const Entry& b) { return a.tag < b.tag; });
        std::vector<std::uint8_t> file{static_cast<std::uint8_t>(big_ ? 'M' : 'I'),
                                       static_cast<std::uint8_t>(big_ ? 'M' : 'I')};
        put(file, std::uint16_t{42});
        put(file, static_cast<std::uint32_t>(8 + data.size()));
        file.insert(file.end(), data.begin(), data.end());
        put(file, static_cast<std::uint16_t>(entries_.size()));
        const std::size_t extra = file.size() + entries_.size() * 12 + 4;
        std::vector<std::uint8_t> behind;
        for (Entry& e : entries_) {
            if (e.tag == 273) put(e.data, std::uint32_t{8});
            if (e.tag == 279) put(e.data, static_cast<std::uint32_t>(data.size()));
            put(file, e.tag), put(file, e.type), put(file, e.count);
            if (e.data.size() <= 4) {
                e.data.resize(4);
                file.insert(file.end(), e.data.begin(), e.data.end());
            } else {
                put(file, static_cast<std::uint32_t>(extra + behind.size()));
                behind.insert(behind.end(), e.data.begin(), e.data.end());
            }
        }
        put(file, std::uint32_t{0});
        file.insert(file.end(), behind.begin(), behind.end());
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
        return path;
    }

  private:
    struct Entry {
        std::uint16_t tag, type;
        std::uint32_t count;
        std::vector<std::uint8_t> data;
    };
    template <class T>
    void put(std::vector<std::uint8_t>& out, T value) const {
        std::uint8_t raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (big_) std::reverse(raw, raw + sizeof(T));
        out.insert(out.end(), raw, raw + sizeof(T));
    }
    void short_(std::uint16_t tag, std::uint32_t value) { shorts(tag, {static_cast<std::uint16_t>(value)}); }

    bool big_;
    std::vector<Entry> entries_;
};

GeoTiff utmTiff(bool bigEndian = false) {
    GeoTiff tiff(3, 2, bigEndian);
    tiff.reals(33550, {0.5, 0.25, 0.0});
    tiff.reals(33922, {0, 0, 0, 482600.0, 1557541.0, 0});
    tiff.text(42113, "-9999");
    return tiff;
}
const std::vector<float> kSix{1, 2, 3, 4, 5, 6};

struct Opened {
    std::unique_ptr<BlockSource> source;
    std::string error;
    std::vector<float> heights{};

    [[nodiscard]] const TerrainInfo& info() const { return source->terrain()->info(); }
    [[nodiscard]] bool notes(const std::string& part) const {
        return std::ranges::any_of(source->info().report.warnings,
                                   [&](const std::string& w) { return w.find(part) != std::string::npos; });
    }
};
Opened openWith(const TerrainOptions& options, std::unique_ptr<BlockSource> meshes = nullptr) {
    Result<std::unique_ptr<BlockSource>> made = addTerrain(std::move(meshes), options);
    if (!made) return {nullptr, made.error().oneLine()};
    Opened opened{std::move(*made), {}};
    const Result<void> read = opened.source->terrain()->readHeights(
        [&](std::uint32_t, std::span<const float> rows) -> Result<void> {
            opened.heights.insert(opened.heights.end(), rows.begin(), rows.end());
            return {};
        });
    EXPECT_TRUE(read);
    return opened;
}
TerrainOptions of(const std::filesystem::path& file) {
    TerrainOptions options;
    options.heights = file;
    return options;
}

TEST(OpenTerrain, ReadsSixteenBitPngFloatExrAndTiffAlike) {
    const TempFolder folder;
    const std::vector<std::uint16_t> whole{0, 1, 2, 65535, 30000, 7};
    const std::vector<float> real{0, 1, 2, 65535, 30000, 7};
    for (const std::filesystem::path& file :
         {writeHeights(folder.path() / "a.png", 3, 2, OIIO::TypeDesc::UINT16, whole),
          writeHeights(folder.path() / "a.exr", 3, 2, OIIO::TypeDesc::FLOAT, real),
          writeHeights(folder.path() / "a.tif", 3, 2, OIIO::TypeDesc::FLOAT, real)}) {
        const Opened opened = openWith(of(file));
        ASSERT_TRUE(opened.source) << opened.error;
        EXPECT_EQ(opened.heights, real) << file;
        EXPECT_EQ(opened.info().columns, 3u);
        EXPECT_EQ(opened.info().rows, 2u);
        EXPECT_EQ(opened.info().highestMetres, 65535.0f);
        EXPECT_TRUE(opened.notes("cells are taken as 1 m wide"));
        EXPECT_EQ(opened.info().firstSample, glm::dvec3(-1.0, 0.0, -0.5));  // the middle at the origin
    }
}

TEST(OpenTerrain, ScalesHeightsAndTakesUnknownOnesOut) {
    const TempFolder folder;
    TerrainOptions options = of(writeHeights(folder.path() / "a.png", 3, 2, OIIO::TypeDesc::UINT16,
                                             std::vector<std::uint16_t>{10, 20, 9, 40, 50, 9}));
    options.heightScale = 0.1;
    options.noData = 9.0;
    options.cellMetres = 4.0;
    const Opened opened = openWith(options);
    ASSERT_TRUE(opened.source) << opened.error;
    EXPECT_FLOAT_EQ(opened.heights[1], 2.0f);
    EXPECT_TRUE(std::isnan(opened.heights[2]) && std::isnan(opened.heights[5]));
    EXPECT_EQ(opened.info().cellMetres, glm::dvec2(4.0));
    EXPECT_TRUE(opened.notes("2 heights are not known"));
    EXPECT_FALSE(opened.notes("1 m wide"));

    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInf = std::numeric_limits<float>::infinity();
    const Opened odd =
        openWith(of(writeHeights(folder.path() / "b.exr", 4, 2, OIIO::TypeDesc::FLOAT,
                                 std::vector<float>{1, 2, kNan, -3.4e38f, 3, 4, kInf, -kInf})));
    ASSERT_TRUE(odd.source) << odd.error;
    EXPECT_TRUE(odd.notes("4 heights are not known"));
    EXPECT_EQ(odd.info().highestMetres, 4.0f);
}

TEST(OpenTerrain, GoesWhereAGeoTiffSays) {
    const TempFolder folder;
    for (const bool bigEndian : {false, true}) {
        const std::filesystem::path file = utmTiff(bigEndian).write(folder.path() / "utm.tif", kSix);
        const Opened opened = openWith(of(file));
        ASSERT_TRUE(opened.source) << opened.error;
        EXPECT_EQ(opened.heights, kSix);
        EXPECT_EQ(opened.info().cellMetres, glm::dvec2(0.5, 0.25));
        // The first sample is the middle of the first pixel: east 482600.25, north 1557540.875.
        EXPECT_EQ(opened.source->info().origin + opened.info().firstSample,
                  glm::dvec3(482600.25, 0.0, -1557540.875));
        TerrainOptions zUp = of(file);
        zUp.up = UpAxis::z;
        const Opened turned = openWith(zUp);
        EXPECT_EQ(turned.source->info().origin + turned.info().firstSample,
                  glm::dvec3(482600.25, 1557540.875, 0.0));
    }
    TerrainOptions wider = of(folder.path() / "utm.tif");
    wider.cellMetres = 2.0;
    EXPECT_EQ(openWith(wider).info().cellMetres, glm::dvec2(2.0));
}

TEST(OpenTerrain, ReadsPixelIsPointAndNoData) {
    const TempFolder folder;
    GeoTiff tiff = utmTiff();
    tiff.shorts(34735, {1, 1, 0, 1, 1025, 0, 1, 2});
    const GeoTags tags = readGeoTags(tiff.write(folder.path() / "p.tif", {1, 2, 3, 4, 5, -9999})).value();
    EXPECT_EQ(*tags.cornerEastNorth, glm::dvec2(482599.75, 1557541.125));
    EXPECT_EQ(*tags.noData, -9999.0);
    EXPECT_TRUE(openWith(of(folder.path() / "p.tif")).notes("1 heights are not known"));
}

TEST(GeoTags, BelieveNoPrefixAndNoByteOfADamagedFile) {
    const TempFolder folder;
    const std::filesystem::path file = utmTiff().write(folder.path() / "utm.tif", kSix);
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> good{std::istreambuf_iterator<char>(stream), {}};
    const auto tagsOf = [&](const std::vector<char>& bytes) {
        std::ofstream(folder.path() / "d.tif", std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return readGeoTags(folder.path() / "d.tif");
    };
    for (std::size_t length = 0; length < good.size(); ++length) {
        const Result<GeoTags> tags =
            tagsOf({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)});
        ASSERT_TRUE(tags);
        EXPECT_FALSE(tags->noData && tags->pixelMetres && tags->cornerEastNorth) << length;
    }
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::vector<char> bytes = good;
        bytes[i] = static_cast<char>(~bytes[i]);
        const Result<GeoTags> tags = tagsOf(bytes);
        ASSERT_TRUE(tags);
        EXPECT_TRUE(!tags->pixelMetres || tags->pixelMetres->x > 0.0);
    }
}

TEST(OpenTerrain, RefusesWhatIsNoTerrainInOneLine) {
    const TempFolder folder;
    const auto lineOf = [&](const std::string& name, int w, int h, std::vector<float> values) {
        return openWith(of(writeHeights(folder.path() / name, w, h, OIIO::TypeDesc::FLOAT, values))).error;
    };
    const auto has = [](const std::string& line, const std::string& part) {
        return line.find(part) != std::string::npos;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(has(lineOf("one.exr", 1, 1, {5}), "one.exr: has 1 x 1 heights, which span no cell"));
    EXPECT_TRUE(has(lineOf("row.exr", 4, 1, {5, 5, 5, 5}), "which span no cell"));
    EXPECT_TRUE(has(lineOf("none.exr", 2, 2, {kNan, kNan, kNan, kNan}), "has no height that is known"));
    EXPECT_TRUE(has(lineOf("scattered.exr", 2, 2, {1, kNan, kNan, 1}), "has no cell"));
    std::ofstream(folder.path() / "text.tif") << "this is no picture at all";
    EXPECT_TRUE(has(openWith(of(folder.path() / "text.tif")).error, "text.tif: byte 0: is not an image"));
    EXPECT_TRUE(has(openWith(of(folder.path() / "nowhere.tif")).error, "nowhere.tif"));
    std::filesystem::resize_file(folder.path() / "none.exr",
                                 std::filesystem::file_size(folder.path() / "none.exr") / 2);
    EXPECT_TRUE(has(openWith(of(folder.path() / "none.exr")).error, "none.exr: cannot be decoded"));
    TerrainOptions options = of(folder.path() / "scattered.exr");
    options.cellMetres = -1.0;
    EXPECT_TRUE(has(openWith(options).error, "--cell-size"));
    options.cellMetres.reset();
    options.heightScale = 0.0;
    EXPECT_TRUE(has(openWith(options).error, "--height-scale"));
}

TEST(OpenTerrain, StretchesADrapeOverTheWholeMap) {
    const TempFolder folder;
    TerrainOptions options = of(writeHeights(folder.path() / "h.exr", 3, 2, OIIO::TypeDesc::FLOAT, kSix));
    std::vector<std::uint8_t> colours(12 * 4 * 3);
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint8_t>(i);
    options.drape = writeHeights(folder.path() / "d.png", 12, 4, OIIO::TypeDesc::UINT8, colours, 3);
    const Opened opened = openWith(options);
    ASSERT_TRUE(opened.source) << opened.error;
    EXPECT_EQ(opened.info().texelsPerCell, glm::dvec2(4.0, 2.0));
    EXPECT_EQ(opened.info().drapeFirst, glm::dvec2(2.0, 1.0));  // the middle of the first pixel of the map
    std::vector<std::uint8_t> read;
    ASSERT_TRUE(opened.source->terrain()->readDrape(
        [&](std::uint32_t, std::span<const std::uint8_t> rows) -> Result<void> {
            read.insert(read.end(), rows.begin(), rows.end());
            return {};
        }));
    EXPECT_EQ(read, colours);
}

// One triangle around a place.
class OneTriangle final : public BlockSource {
  public:
    OneTriangle(const glm::dvec3& origin, const glm::dvec3& size) {
        info_.name = "mesh";
        info_.origin = origin;
        info_.bounds = {glm::dvec3(0.0), size};
    }
    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return 1; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t) const override { return SourceBlock{}; }

  private:
    SourceInfo info_;
};

TEST(OpenTerrain, LiesUnderTheMeshesByCoordinatesOrByTheirMiddle) {
    const TempFolder folder;
    const std::filesystem::path file = utmTiff().write(folder.path() / "utm.tif", kSix);
    const Opened near =
        openWith(of(file), std::make_unique<OneTriangle>(glm::dvec3(482600, 40, -1557541), glm::dvec3(1.0)));
    ASSERT_TRUE(near.source) << near.error;
    EXPECT_EQ(near.source->info().origin, glm::dvec3(482600, 40, -1557541));
    EXPECT_EQ(near.info().firstSample, glm::dvec3(0.25, -40.0, 0.125));
    EXPECT_EQ(near.source->blockCount(), 1u);
    const Opened far =
        openWith(of(file), std::make_unique<OneTriangle>(glm::dvec3(0), glm::dvec3(4.0, 1.0, 4.0)));
    EXPECT_TRUE(far.notes("its coordinates are not under the meshes"));
    EXPECT_EQ(far.info().firstSample, glm::dvec3(1.5, 0.0, 1.875));  // 1 m x 0.25 m around (2, 2)
}

TEST(WalkOnTerrain, FollowsTheGroundAndKeepsOffHoles) {
    const TempFolder folder;
    std::vector<float> slope(41 * 41);
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = static_cast<float>(i % 41) * 0.5f;
    const Opened opened =
        openWith(of(writeHeights(folder.path() / "s.exr", 41, 41, OIIO::TypeDesc::FLOAT, slope)));
    ASSERT_EQ(opened.source->info().walks.size(), 1u);
    for (const glm::dvec3& p : opened.source->info().walks[0].points)
        EXPECT_NEAR(p.y, (p.x + 20.0) * 0.5, 1e-5);
    slope[20 * 41 + 12] = std::numeric_limits<float>::quiet_NaN();
    const Opened holed =
        openWith(of(writeHeights(folder.path() / "t.exr", 41, 41, OIIO::TypeDesc::FLOAT, slope)));
    EXPECT_TRUE(holed.source->info().walks.empty());
}

}  // namespace
}  // namespace fb::test
