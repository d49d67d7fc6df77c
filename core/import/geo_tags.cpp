#include "import/geo_tags.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "import/parse_bytes.h"
#include "import/parse_text.h"

namespace fb {
namespace {

constexpr std::uint16_t kPixelScale = 33550, kTiePoint = 33922, kGeoKeys = 34735, kGdalNoData = 42113;
constexpr std::uint64_t kMostEntries = 65535, kMostTagBytes = 65536;
constexpr std::uint16_t kRasterTypeKey = 1025;
constexpr double kLeastScale = 1e-12;

struct TiffTags {
    const FileReader& file;
    bool bigEndian = false, isBig = false;
    GeoTags found{};
    std::vector<double> tie{};
    bool pixelIsPoint = false;

    [[nodiscard]] bool read(std::uint64_t at, std::vector<std::uint8_t>& into, std::uint64_t size) const {
        if (size > kMostTagBytes * 32 || at > file.sizeBytes() || size > file.sizeBytes() - at) return false;
        into.resize(size);
        return bool(file.readAt(at, into));
    }
    template <class T>
    [[nodiscard]] T number(const std::uint8_t* bytes) const {
        return loadNumber<T>(bytes, bigEndian);
    }

    // False where there is no directory to read.
    bool directory(std::vector<std::uint8_t>& entries, std::uint64_t& count) {
        std::vector<std::uint8_t> head;
        if (!read(0, head, 16)) return false;
        const bool little = head[0] == 'I' && head[1] == 'I', big = head[0] == 'M' && head[1] == 'M';
        if (!little && !big) return false;
        bigEndian = big;
        const auto version = number<std::uint16_t>(&head[2]);
        if (version != 42 && version != 43) return false;
        isBig = version == 43;
        const std::uint64_t at = isBig ? number<std::uint64_t>(&head[8]) : number<std::uint32_t>(&head[4]);
        std::vector<std::uint8_t> counted;
        if (!read(at, counted, isBig ? 8 : 2)) return false;
        count = isBig ? number<std::uint64_t>(counted.data()) : number<std::uint16_t>(counted.data());
        return count <= kMostEntries && read(at + counted.size(), entries, count * entryBytes());
    }
    [[nodiscard]] std::uint64_t entryBytes() const { return isBig ? 20 : 12; }

    // The tag's values, where its type is `type`.
    [[nodiscard]] bool values(const std::uint8_t* entry, std::uint16_t type, std::uint64_t each,
                              std::vector<std::uint8_t>& into) const {
        if (number<std::uint16_t>(entry + 2) != type) return false;
        const std::uint64_t count =
            isBig ? number<std::uint64_t>(entry + 4) : number<std::uint32_t>(entry + 4);
        if (count > kMostTagBytes / each) return false;
        const std::uint8_t* inside = entry + (isBig ? 12 : 8);
        const std::uint64_t size = count * each;
        if (size <= (isBig ? 8u : 4u)) {
            into.assign(inside, inside + size);
            return true;
        }
        const std::uint64_t at = isBig ? number<std::uint64_t>(inside) : number<std::uint32_t>(inside);
        return read(at, into, size);
    }
    [[nodiscard]] std::vector<double> reals(const std::uint8_t* entry) const {
        std::vector<std::uint8_t> bytes;
        std::vector<double> out;
        constexpr std::uint16_t kDouble = 12;
        if (!values(entry, kDouble, 8, bytes)) return out;
        for (std::size_t i = 0; i < bytes.size(); i += 8) out.push_back(number<double>(&bytes[i]));
        return out;
    }
    void take(const std::uint8_t* entry) {
        std::vector<std::uint8_t> bytes;
        switch (number<std::uint16_t>(entry)) {
            case kPixelScale: {
                const std::vector<double> scale = reals(entry);
                if (scale.size() < 2 || !(scale[0] > kLeastScale) || !(scale[1] > kLeastScale)) return;
                if (std::isfinite(scale[0]) && std::isfinite(scale[1]))
                    found.pixelMetres = {scale[0], scale[1]};
                return;
            }
            case kTiePoint:
                tie = reals(entry);
                return;
            case kGeoKeys:
                // Four shorts a key: number, where its value lies (0: here), count, value.
                if (!values(entry, 3, 2, bytes)) return;
                for (std::size_t i = 8; i + 8 <= bytes.size(); i += 8) {
                    if (number<std::uint16_t>(&bytes[i]) != kRasterTypeKey) continue;
                    pixelIsPoint = number<std::uint16_t>(&bytes[i + 2]) == 0 &&
                                   number<std::uint16_t>(&bytes[i + 6]) == 2;
                }
                return;
            case kGdalNoData: {
                if (!values(entry, 2, 1, bytes)) return;
                std::string text(bytes.begin(), bytes.end());
                text.resize(text.find_last_not_of('\0') + 1);
                double value = 0.0;
                if (toReal(trimmed(text), value)) found.noData = value;
                return;
            }
            default:
                return;
        }
    }
    void place() {
        if (!found.pixelMetres || tie.size() < 6) return;
        for (std::size_t i = 0; i < 6; ++i) {
            if (!std::isfinite(tie[i])) return;
        }
        // Where pixels are points, the tie point is the middle of a pixel.
        const double half = pixelIsPoint ? 0.5 : 0.0;
        found.cornerEastNorth = {tie[3] - (tie[0] + half) * found.pixelMetres->x,
                                 tie[4] + (tie[1] + half) * found.pixelMetres->y};
    }
};

}  // namespace

Result<GeoTags> readGeoTags(const std::filesystem::path& path) {
    Result<FileReader> file = FileReader::open(path);
    if (!file) return passOn(file);
    TiffTags tags{*file};
    std::vector<std::uint8_t> entries;
    std::uint64_t count = 0;
    if (!tags.directory(entries, count)) return GeoTags{};
    for (std::uint64_t i = 0; i < count; ++i) tags.take(&entries[i * tags.entryBytes()]);
    tags.place();
    return tags.found;
}

}  // namespace fb
