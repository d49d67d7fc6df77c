#include "import/open_terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "import/geo_tags.h"
#include "import/hash_file.h"
#include "import/height_rows.h"
#include "import/import_limits.h"
#include "import/texture_reader.h"

namespace fb {
namespace {

constexpr std::uint64_t kTerrainImportVersion = 1;  // raise it when the same files give other heights
// A larger value means nothing: no height, but a fill value such as the lowest float.
constexpr double kMostMetres = 1e9;
constexpr int kStripRows = 64;

Result<std::unique_ptr<TextureReader>> openDrape(const std::filesystem::path& file) {
    return TextureReader::open({file.string(), file, {}}, TextureUse::byTiles);
}

class TerrainFile final : public TerrainSource {
  public:
    TerrainFile(TerrainInfo info, const TerrainOptions& options, std::optional<double> noData)
        : info_(std::move(info)), options_(options), noData_(noData) {}

    [[nodiscard]] const TerrainInfo& info() const override { return info_; }
    [[nodiscard]] TerrainInfo& change() { return info_; }

    [[nodiscard]] Result<void> readHeights(const TakeHeights& take) const override {
        Result<HeightRows> image = HeightRows::open(options_.heights);
        if (!image) return passOn(image);
        std::vector<float> heights;
        return image->readValues([&](std::uint32_t first, std::span<const double> values) -> Result<void> {
            heights.resize(values.size());
            std::transform(values.begin(), values.end(), heights.begin(),
                           [&](double v) { return heightOf(v); });
            return take(first, heights);
        });
    }
    [[nodiscard]] Result<void> readDrape(const TakeTexels& take) const override {
        Result<std::unique_ptr<TextureReader>> opened = openDrape(*options_.drape);
        if (!opened) return passOn(opened);
        TextureReader& reader = **opened;
        const TextureHeader& header = reader.header();
        const auto width = static_cast<std::size_t>(header.width), channels = static_cast<std::size_t>(header.channels);
        const int strip = header.tileHeight > 0 ? header.tileHeight : kStripRows;
        std::vector<std::uint8_t> texels(width * channels * static_cast<std::size_t>(strip));
        std::vector<std::uint8_t> colours(width * 3 * static_cast<std::size_t>(strip));
        for (int row = 0; row < header.height; row += strip) {
            const int end = std::min(row + strip, header.height);
            if (Result<void> read = reader.readRows(row, end, texels.data()); !read) return read;
            const std::size_t count = width * static_cast<std::size_t>(end - row);
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t k = 0; k < 3; ++k)
                    colours[i * 3 + k] = texels[i * channels + (channels >= 3 ? k : 0)];
            }
            if (Result<void> taken = take(static_cast<std::uint32_t>(row), std::span(colours).first(count * 3)); !taken)
                return taken;
        }
        return {};
    }

  private:
    [[nodiscard]] float heightOf(double value) const {
        constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
        // A no-data value is often written with more digits than the pixels have.
        if (noData_ && (value == *noData_ || static_cast<float>(value) == static_cast<float>(*noData_)))
            return kUnknown;
        const double metres = value * options_.heightScale;
        return std::abs(metres) <= kMostMetres ? static_cast<float>(metres) : kUnknown;
    }

    TerrainInfo info_;
    TerrainOptions options_;
    std::optional<double> noData_;
};

class TerrainScene final : public BlockSource {
  public:
    TerrainScene(std::unique_ptr<BlockSource> meshes, std::unique_ptr<TerrainFile> terrain, SourceInfo info)
        : meshes_(std::move(meshes)), terrain_(std::move(terrain)), info_(std::move(info)) {}

    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return meshes_ ? meshes_->blockCount() : 0; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t block) const override {
        if (meshes_) return meshes_->load(block);
        return failure(info_.name, "block " + std::to_string(block), "does not exist");
    }
    [[nodiscard]] const TerrainSource* terrain() const override { return terrain_.get(); }

  private:
    std::unique_ptr<BlockSource> meshes_;
    std::unique_ptr<TerrainFile> terrain_;
    SourceInfo info_;
};

// A map's rectangle between its outer samples, as coordinates of the source's two level axes.
struct PlanBox {
    glm::dvec2 low, high;
    [[nodiscard]] bool touches(const PlanBox& other) const {
        return low.x <= other.high.x && low.y <= other.high.y && other.low.x <= high.x &&
               other.low.y <= high.y;
    }
};

glm::dvec2 levelOf(const glm::dvec3& p, UpAxis up) {
    return up == UpAxis::y ? glm::dvec2(p.x, p.z) : glm::dvec2(p.x, p.y);
}
glm::dvec3 placeOf(const glm::dvec2& level, UpAxis up) {
    return up == UpAxis::y ? glm::dvec3(level.x, 0.0, level.y) : glm::dvec3(level.x, level.y, 0.0);
}
// East and north as the level axes of the scene.
glm::dvec2 levelOfMap(const glm::dvec2& eastNorth, UpAxis up) {
    return {eastNorth.x, up == UpAxis::y ? -eastNorth.y : eastNorth.y};
}

class TerrainOpener {
  public:
    TerrainOpener(std::unique_ptr<BlockSource> meshes, const TerrainOptions& options)
        : meshes_(std::move(meshes)), options_(options) {}

    Result<std::unique_ptr<BlockSource>> run() {
        if (meshes_) info_ = meshes_->info();
        if (!meshes_) info_.up = options_.up.value_or(UpAxis::y);
        if (!options_.name.empty() || !meshes_) {
            info_.name = options_.name.empty() ? options_.heights.stem().string() : options_.name;
        }
        if (Result<void> measured = measure(); !measured) return passOn(measured);
        if (Result<void> draped = drape(); !draped) return passOn(draped);
        place();
        if (Result<void> hashed = hash(); !hashed) return passOn(hashed);
        auto terrain = std::make_unique<TerrainFile>(map_, options_, noData_);
        Result<std::uint64_t> unknown = surveyTerrain(*terrain, terrain->change());
        if (!unknown) return passOn(unknown);
        if (*unknown > 0) note(std::to_string(*unknown) + " heights are not known and leave holes");
        if (info_.walks.empty()) {
            Result<std::optional<WalkHint>> walk = walkOnTerrain(*terrain);
            if (!walk) return passOn(walk);
            if (*walk) info_.walks.push_back(std::move(**walk));
        }
        return std::make_unique<TerrainScene>(std::move(meshes_), std::move(terrain), std::move(info_));
    }

  private:
    void note(const std::string& line) {
        info_.report.warnings.push_back(options_.heights.filename().string() + ": " + line);
    }

    Result<void> measure() {
        Result<HeightRows> image = HeightRows::open(options_.heights);
        if (!image) return passOn(image);
        Result<GeoTags> tags = readGeoTags(options_.heights);
        if (!tags) return passOn(tags);
        map_.name = options_.heights.string();
        map_.columns = image->width();
        map_.rows = image->height();
        map_.up = info_.up;
        noData_ = options_.noData ? options_.noData : tags->noData;
        if (options_.cellMetres) {
            map_.cellMetres = glm::dvec2(*options_.cellMetres);
        } else if (tags->pixelMetres) {
            map_.cellMetres = *tags->pixelMetres;
        } else {
            note("says nothing of its scale: cells are taken as 1 m wide (--cell-size METRES)");
        }
        corner_ = tags->cornerEastNorth;
        info_.files.push_back(options_.heights);
        return {};
    }

    // The map's upper left sample is the middle of its first pixel.
    void place() {
        const glm::dvec2 span = glm::dvec2(map_.columns - 1, map_.rows - 1) * map_.cellMetres;
        const double south =
            info_.up == UpAxis::y ? 1.0 : -1.0;  // of the second level axis per metre southward
        const auto boxAt = [&](const glm::dvec2& first) {
            const glm::dvec2 last = first + glm::dvec2(span.x, south * span.y);
            return PlanBox{glm::min(first, last), glm::max(first, last)};
        };
        if (corner_) {
            const glm::dvec2 middleOfPixel = *corner_ + 0.5 * map_.cellMetres * glm::dvec2(1.0, -1.0);
            const glm::dvec2 first = levelOfMap(middleOfPixel, info_.up);
            const PlanBox box = boxAt(first);
            if (!meshes_) {
                info_.origin = placeOf(glm::round(0.5 * (box.low + box.high)), info_.up);
                map_.firstSample = placeOf(first, info_.up) - info_.origin;
                return;
            }
            const PlanBox below{levelOf(info_.origin + info_.bounds.min, info_.up),
                                levelOf(info_.origin + info_.bounds.max, info_.up)};
            if (box.touches(below)) {
                map_.firstSample =
                    placeOf(first - levelOf(info_.origin, info_.up), info_.up) -
                    info_.origin * (info_.up == UpAxis::y ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
                return;
            }
            note(
                "its coordinates are not under the meshes: its middle is put under theirs, heights as they "
                "are");
        }
        const glm::dvec2 middle = meshes_ ? levelOf(info_.bounds.centre(), info_.up) : glm::dvec2(0.0);
        map_.firstSample = placeOf(middle - 0.5 * glm::dvec2(span.x, south * span.y), info_.up);
        if (meshes_) {
            map_.firstSample -=
                info_.origin * (info_.up == UpAxis::y ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
        }
    }

    Result<void> drape() {
        if (!options_.drape) return {};
        Result<std::unique_ptr<TextureReader>> opened = openDrape(*options_.drape);
        if (!opened) return passOn(opened);
        const TextureHeader header = (*opened)->header();
        Result<GeoTags> tags = readGeoTags(*options_.drape);
        if (!tags) return passOn(tags);
        const glm::dvec2 texels(header.width, header.height), pixels(map_.columns, map_.rows);
        map_.drapeWidth = header.width;
        map_.drapeHeight = header.height;
        map_.drapeLossless = header.lossless;
        map_.texelsPerCell = texels / pixels;
        map_.drapeFirst = 0.5 * map_.texelsPerCell;
        if (tags->cornerEastNorth && tags->pixelMetres && corner_) {
            // Coordinates run north, rows south.
            const glm::dvec2 first = *corner_ + 0.5 * map_.cellMetres * glm::dvec2(1.0, -1.0);
            const glm::dvec2 inside =
                (first - *tags->cornerEastNorth) * glm::dvec2(1.0, -1.0) / *tags->pixelMetres;
            const glm::dvec2 each = map_.cellMetres / *tags->pixelMetres;
            const glm::dvec2 last = inside + each * (pixels - 1.0);
            if (last.x > 0.0 && last.y > 0.0 && inside.x < texels.x && inside.y < texels.y) {
                map_.drapeFirst = inside;
                map_.texelsPerCell = each;
            } else {
                note("the coordinates of its drape lie elsewhere: it is stretched over the whole map");
            }
        }
        info_.files.push_back(*options_.drape);
        return {};
    }

    Result<void> hash() {
        Hasher hasher;
        hasher.text("terrain").number(kTerrainImportVersion).number(static_cast<std::uint64_t>(map_.up));
        for (const std::optional<std::filesystem::path>& file :
             {std::optional(options_.heights), options_.drape}) {
            if (!file) continue;
            Result<std::uint64_t> content = hashFile(*file);
            if (!content) return passOn(content);
            hasher.number(*content);
        }
        hasher.number(options_.heightScale)
            .number(std::uint64_t{noData_ ? 1u : 0u})
            .number(noData_.value_or(0.0));
        for (const glm::dvec2& v : {map_.cellMetres, map_.drapeFirst, map_.texelsPerCell})
            hasher.number(v.x).number(v.y);
        for (int axis = 0; axis < 3; ++axis) hasher.number(map_.firstSample[axis]);
        map_.sourceHash = hasher.digest();
        info_.sourceHash =
            meshes_ ? Hasher().number(info_.sourceHash).number(map_.sourceHash).digest() : map_.sourceHash;
        return {};
    }

    std::unique_ptr<BlockSource> meshes_;
    const TerrainOptions& options_;
    SourceInfo info_;
    TerrainInfo map_;
    std::optional<glm::dvec2> corner_;
    std::optional<double> noData_;
};

Result<void> checkOptions(const TerrainOptions& options) {
    const auto usable = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (options.cellMetres && !(usable(*options.cellMetres) && *options.cellMetres <= kMostMetres)) {
        return usageFailure("--cell-size", "must be above 0 and at most 1e9 metres");
    }
    if (!usable(std::abs(options.heightScale)) || std::abs(options.heightScale) > kMostMetres) {
        return usageFailure("--height-scale", "must be a number other than 0");
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<BlockSource>> addTerrain(std::unique_ptr<BlockSource> meshes,
                                                const TerrainOptions& options) {
    if (Result<void> checked = checkOptions(options); !checked) return passOn(checked);
    try {
        return TerrainOpener(std::move(meshes), options).run();
    } catch (const std::bad_alloc&) {
        return failure(options.heights.string(), {}, "needs more memory than there is");
    }
}

}  // namespace fb
