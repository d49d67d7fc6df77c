#include "import/hash_file.h"

#include <algorithm>
#include <vector>

#include "base/file_io.h"
#include "base/hash.h"

namespace fb {

Result<std::uint64_t> hashFile(const std::filesystem::path& path) {
    Result<FileReader> file = FileReader::open(path);
    if (!file) return passOn(file);
    Hasher hasher;
    std::vector<std::uint8_t> chunk(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < file->sizeBytes(); at += chunk.size()) {
        const std::uint64_t left = file->sizeBytes() - at;
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, chunk.size()));
        if (Result<void> read = file->readAt(at, {chunk.data(), size}); !read) return passOn(read);
        hasher.bytes(chunk.data(), size);
    }
    return hasher.digest();
}

}  // namespace fb
