#include "import/image_format.h"

#include <algorithm>
#include <array>

#include "import/parse_text.h"

namespace fb {
namespace {

// Interlaced pictures are complete only when all of the file has been read.
bool isInterlacedPng(const ByteSource& bytes) {
    constexpr std::uint64_t kInterlaceByte = 28;  // last of the header chunk
    std::array<std::uint8_t, 1> method{};
    return !bytes.readAt(kInterlaceByte, method) || method[0] != 0;
}

// Frames coded in one pass over the rows: baseline and extended sequential (ITU T.81, table B.1). All others, the
// progressive ones first, are held whole by the decoder.
bool isSequentialJpeg(const ByteSource& bytes) {
    constexpr int kMostSegments = 4096;
    std::uint64_t at = 2;
    for (int i = 0; i < kMostSegments; ++i) {
        std::array<std::uint8_t, 4> head{};
        if (!bytes.readAt(at, head) || head[0] != 0xff) return false;
        if (head[1] == 0xff) {  // padding
            ++at;
            continue;
        }
        if (head[1] == 0xc0 || head[1] == 0xc1) return true;
        const bool isFrame =
            head[1] >= 0xc2 && head[1] <= 0xcf && head[1] != 0xc4 && head[1] != 0xc8 && head[1] != 0xcc;
        if (isFrame || head[1] == 0xd9 || head[1] == 0xda) return false;
        at += 2 + static_cast<std::uint64_t>(head[2] << 8 | head[3]);
    }
    return false;
}

}  // namespace

std::optional<ImageFormat> recogniseImage(const ByteSource& bytes, std::string_view name) {
    std::array<std::uint8_t, 32> start{};
    const std::size_t size = std::min<std::size_t>(bytes.sizeBytes(), start.size());
    if (!bytes.readAt(0, {start.data(), size})) return std::nullopt;
    const std::string_view text(reinterpret_cast<const char*>(start.data()), size);
    if (startsWith(text, "\x89PNG")) return ImageFormat{"png", true, false, false, !isInterlacedPng(bytes)};
    if (startsWith(text, "\xff\xd8\xff")) {
        return ImageFormat{"jpeg", false, false, false, isSequentialJpeg(bytes)};
    }
    if (startsWith(text, std::string_view("II*\0", 4)) || startsWith(text, std::string_view("MM\0*", 4)) ||
        startsWith(text, std::string_view("II+\0", 4)) || startsWith(text, std::string_view("MM\0+", 4))) {
        return ImageFormat{"tiff", true, false, false, true};
    }
    if (startsWith(text, "RIFF") && text.size() >= 16 && text.substr(8, 4) == "WEBP") {
        return ImageFormat{"webp", text.substr(12, 4) == "VP8L", true, true};
    }
    if (startsWith(text, "BM")) return ImageFormat{"bmp", true, false};
    if (startsWith(text, "GIF8")) return ImageFormat{"gif", true, false};
    if (startsWith(text, "#?RADIANCE") || startsWith(text, "#?RGBE")) return ImageFormat{"hdr", true, false};
    if (startsWith(text, "\x76\x2f\x31\x01")) return ImageFormat{"openexr", true, false, false, true};
    if (startsWith(text, "DDS ")) return ImageFormat{"dds", false, false};
    if (startsWith(text, "8BPS")) return ImageFormat{"psd", true, false};
    if (startsWith(text, std::string_view("\0\0\0\x0cjP", 6))) return ImageFormat{"jpeg2000", false, true};
    if (text.size() > 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6')
        return ImageFormat{"pnm", true, false};
    const std::string lower = lowerCase(name);
    if (lower.size() > 4 && lower.substr(lower.size() - 4) == ".tga")
        return ImageFormat{"targa", true, false};
    return std::nullopt;
}

}  // namespace fb
