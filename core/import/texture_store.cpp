#include "import/texture_store.h"

#include <OpenImageIO/imagecache.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <new>
#include <thread>

#include "base/check.h"
#include "base/file_io.h"
#include "base/hash.h"
#include "import/cached_texture.h"

namespace fb {
namespace {

// Pictures in rows are cut into tiles of this many texels.
constexpr int kCacheTile = 64;
constexpr std::size_t kHashedAtOnce = std::size_t{1} << 20;

std::uint64_t hashOfFile(const std::filesystem::path& path) {
    Hasher hasher;
    const auto refused = [&](const Error& error) { return Hasher().text(error.oneLine()).digest(); };
    const Result<FileReader> file = FileReader::open(path);
    if (!file) return refused(file.error());
    hasher.number(file->sizeBytes());
    std::vector<std::uint8_t> part(kHashedAtOnce);
    for (std::uint64_t at = 0; at < file->sizeBytes();) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(part.size(), file->sizeBytes() - at));
        if (const Result<void> read = file->readAt(at, {part.data(), count}); !read) return refused(read.error());
        hasher.bytes(part.data(), count);
        at += count;
    }
    return hasher.digest();
}

// Memory that the tiles of one row of tiles take while it is decoded.
std::uint64_t stripBytes(const TextureHeader& header) {
    const int rows = std::max(header.tileHeight, kCacheTile);
    return static_cast<std::uint64_t>(header.width + kCacheTile) * static_cast<std::uint64_t>(rows) *
           static_cast<std::uint64_t>(header.channels);
}

std::uint64_t pictureBytes(const TextureHeader& header) {
    return static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height) *
           static_cast<std::uint64_t>(header.channels);
}

}  // namespace

struct TextureStore::State {
    struct FileHash {
        std::once_flag made;
        std::uint64_t hash = 0;
    };

    // Before the cache, whose inputs look into them.
    std::map<std::string, std::unique_ptr<CachedTexture>> textures;
    std::map<std::filesystem::path, std::unique_ptr<FileHash>> hashes;
    std::mutex mutex;  // of both maps and of cacheBytes
    DecodeCounts decodeCounts;
    std::atomic<std::uint64_t> opened = 0, filesHashed = 0;
    std::uint64_t cacheBytes = 0;
    OIIO::ImageCache* cache = nullptr;

    void limitCache(std::uint64_t bytes) {
        cacheBytes = bytes;
        cache->attribute("max_memory_MB", static_cast<float>(static_cast<double>(bytes) / (1 << 20)));
    }

    // Two rows of tiles for every thread: with less, rows would be decoded again for each of their tiles.
    void makeRoomForStrips(const TextureHeader& header) {
        const std::uint64_t least = stripBytes(header) * 2 * (std::thread::hardware_concurrency() + 1);
        const std::scoped_lock lock(mutex);
        if (cacheBytes < least) limitCache(least);
    }

    CachedTexture& find(const SourceTexture& texture) {
        // No path contains a null character: keys of memory do not meet paths.
        std::string key = texture.file.string();
        if (texture.file.empty()) {
            key = std::string(1, '\0') +
                  hashText(hashBytes(texture.encoded.data(), texture.encoded.size())) + " " +
                  std::to_string(texture.encoded.size());
        }
        const std::scoped_lock lock(mutex);
        std::unique_ptr<CachedTexture>& found = textures[key];
        if (found == nullptr) {
            found = std::make_unique<CachedTexture>();
            found->name = texture.name;
            found->file = texture.file;
            if (texture.file.empty()) found->encoded = texture.encoded;
            found->counts = &decodeCounts;
        }
        return *found;
    }

    void openOnce(CachedTexture& texture) {
        ++opened;
        Result<std::unique_ptr<TextureReader>> reader =
            TextureReader::open(texture.bytes(), TextureUse::byTiles);
        if (!reader) {
            texture.refusal = std::move(reader.error());
            return;
        }
        texture.header = (*reader)->header();
        reader->reset();
        makeRoomForStrips(texture.header);
        // A name of our own: the cache must not look for a file.
        const OIIO::ustring name("frontbench:" + std::to_string(reinterpret_cast<std::uintptr_t>(&texture)));
        const OIIO::ImageSpec config = configOf(texture);
        if (cache->add_file(name, &cachedTextureInput, &config)) texture.handle = cache->get_image_handle(name);
        if (texture.handle == nullptr || !cache->good(handleOf(texture))) refuse(texture);
    }

    void refuse(CachedTexture& texture) const { texture.refusal = brokenTexture(texture); }

    [[nodiscard]] Error brokenTexture(const CachedTexture& texture) const {
        std::string reason = cache->geterror();
        while (!reason.empty() && (reason.back() == '\n' || reason.back() == ' ')) reason.pop_back();
        return {Error::Kind::failed,
                texture.file.empty() ? texture.name : texture.file.string(),
                {},
                reason.empty() ? "cannot be decoded" : "cannot be decoded: " + reason,
                "the file is damaged, or a variant that is not supported"};
    }

    static OIIO::ImageCache::ImageHandle* handleOf(const CachedTexture& texture) {
        return static_cast<OIIO::ImageCache::ImageHandle*>(texture.handle);
    }

    bool readCached(const CachedTexture& texture, const StoredRect& rect, std::uint8_t* into) const {
        return cache->get_pixels(handleOf(texture), nullptr, 0, 0, rect.x, rect.x + rect.width, rect.y,
                                 rect.y + rect.height, 0, 1, OIIO::TypeDesc::UINT8, into);
    }

    // A decoder of rows goes from top to bottom: when all of it stays in the cache, every row at once, since blocks
    // ask for their parts in any order.
    void decodeOnce(CachedTexture& texture) {
        const TextureHeader& header = texture.header;
        std::uint64_t limit = 0;
        {
            const std::scoped_lock lock(mutex);
            limit = cacheBytes;
        }
        if (header.tileHeight > 0 || pictureBytes(header) > limit / 2) return;
        std::vector<std::uint8_t> texel(static_cast<std::size_t>(header.channels));
        for (int y = 0; y < header.height; y += kCacheTile) {
            if (!readCached(texture, {0, y, 1, 1}, texel.data())) return;  // told by the read that needs it
        }
    }
};

TextureStore::TextureStore(std::uint64_t cacheBytes) : state_(std::make_unique<State>()) {
    state_->cache = OIIO::ImageCache::create(false);
    FB_CHECK(state_->cache != nullptr);
    state_->limitCache(cacheBytes);
    state_->cache->attribute("autotile", kCacheTile);
    state_->cache->attribute("deduplicate", 0);
}

TextureStore::~TextureStore() { OIIO::ImageCache::destroy(state_->cache, true); }

Result<StoredTexture> TextureStore::open(const SourceTexture& texture) try {
    if (texture.file.empty() && texture.image) {
        if (Result<void> sound = checkPixels(texture); !sound) return passOn(sound);
        const Image& image = *texture.image;
        return StoredTexture{
            {image.width, image.height, image.channels, image.lossless, 0, 0}, texture.image, nullptr};
    }
    CachedTexture& cached = state_->find(texture);
    std::call_once(cached.opened, [&] { state_->openOnce(cached); });
    if (cached.refusal) return tl::make_unexpected(*cached.refusal);
    return StoredTexture{cached.header, nullptr, &cached};
} catch (const std::bad_alloc&) {
    return failure(texture.name, {}, "needs more memory than there is");
}

Result<void> TextureStore::read(const StoredTexture& texture, const StoredRect& rect, std::uint8_t* into) {
    if (texture.pixels == nullptr) {
        CachedTexture& cached = *texture.cached;
        try {
            std::call_once(cached.decoded, [&] { state_->decodeOnce(cached); });
            if (state_->readCached(cached, rect, into)) return {};
        } catch (const std::bad_alloc&) {
            return failure(cached.name, {}, "needs more memory than there is");
        }
        return tl::make_unexpected(state_->brokenTexture(cached));
    }
    const Image& image = *texture.pixels;
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t row = static_cast<std::size_t>(rect.width) * channels;
    for (int y = 0; y < rect.height; ++y) {
        const std::size_t at = static_cast<std::size_t>(rect.y + y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(rect.x);
        std::memcpy(into + static_cast<std::size_t>(y) * row, image.pixels.data() + at * channels, row);
    }
    return {};
}

std::uint64_t TextureStore::hashFile(const std::filesystem::path& file) {
    State::FileHash* entry = nullptr;
    {
        const std::scoped_lock lock(state_->mutex);
        std::unique_ptr<State::FileHash>& found = state_->hashes[file];
        if (found == nullptr) found = std::make_unique<State::FileHash>();
        entry = found.get();
    }
    std::call_once(entry->made, [&] {
        entry->hash = hashOfFile(file);
        ++state_->filesHashed;
    });
    return entry->hash;
}

TextureStoreCounts TextureStore::counts() const {
    return {state_->opened, state_->decodeCounts.texelsDecoded, state_->decodeCounts.startedOver,
            state_->filesHashed};
}

}  // namespace fb
