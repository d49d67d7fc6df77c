#include "base/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace fb {
namespace {

std::string systemReason(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

void syncFolderOf(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);  // some file systems refuse to sync a folder; the rename itself has been done
    ::close(descriptor);
}

}  // namespace

FileReader::~FileReader() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileReader::FileReader(FileReader&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), sizeBytes_(other.sizeBytes_), path_(std::move(other.path_)) {}

FileReader& FileReader::operator=(FileReader&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(sizeBytes_, other.sizeBytes_);
    std::swap(path_, other.path_);
    return *this;
}

Result<FileReader> FileReader::open(const std::filesystem::path& path) {
    FileReader reader;
    reader.path_ = path;
    // O_NONBLOCK: opening a named pipe would wait for a writer; it changes nothing for files.
    reader.descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (reader.descriptor_ < 0) return failure(path.string(), {}, systemReason("cannot be opened"));
    struct stat status {};
    if (::fstat(reader.descriptor_, &status) != 0) return failure(path.string(), {}, systemReason("cannot be read"));
    if (!S_ISREG(status.st_mode)) return failure(path.string(), {}, "is not a file");
    reader.sizeBytes_ = static_cast<std::uint64_t>(status.st_size);
    return reader;
}

Result<void> FileReader::readAt(std::uint64_t offset, std::span<std::uint8_t> into) const {
    std::size_t done = 0;
    while (done < into.size()) {
        const ssize_t got = ::pread(descriptor_, into.data() + done, into.size() - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        const std::string place = "byte " + std::to_string(offset + done);
        if (got < 0) return failure(path_.string(), place, systemReason("cannot be read"));
        if (got == 0) return failure(path_.string(), place, "the file ends too early");
        done += static_cast<std::size_t>(got);
    }
    return {};
}

Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& path, std::uint64_t capBytes) {
    Result<FileReader> reader = FileReader::open(path);
    if (!reader) return passOn(reader);
    if (reader->sizeBytes() > capBytes) {
        return failure(path.string(), {}, "is larger than " + std::to_string(capBytes) + " bytes");
    }
    std::vector<std::uint8_t> bytes(reader->sizeBytes());
    if (Result<void> read = reader->readAt(0, bytes); !read) return passOn(read);
    return bytes;
}

AtomicFile::~AtomicFile() { discard(); }

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      offset_(other.offset_),
      finalPath_(std::move(other.finalPath_)),
      temporaryPath_(std::move(other.temporaryPath_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(offset_, other.offset_);
    std::swap(finalPath_, other.finalPath_);
    std::swap(temporaryPath_, other.temporaryPath_);
    return *this;
}

void AtomicFile::discard() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(temporaryPath_.c_str());
    descriptor_ = -1;
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& finalPath) {
    AtomicFile file;
    file.finalPath_ = finalPath;
    std::string pattern = finalPath.string() + ".XXXXXX.part";
    file.descriptor_ = ::mkostemps(pattern.data(), 5, O_CLOEXEC);
    if (file.descriptor_ < 0) return failure(finalPath.string(), {}, systemReason("cannot be written"));
    ::fchmod(file.descriptor_, 0644);
    file.temporaryPath_ = pattern;
    return file;
}

Result<void> AtomicFile::write(std::span<const std::uint8_t> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) {
            const std::string reason = systemReason("cannot be written");
            discard();
            return failure(finalPath_.string(), "byte " + std::to_string(offset_), reason);
        }
        done += static_cast<std::size_t>(put);
        offset_ += static_cast<std::uint64_t>(put);
    }
    return {};
}

Result<void> AtomicFile::finish() {
    if (::fsync(descriptor_) != 0) {
        const std::string reason = systemReason("cannot be synced to disk");
        discard();
        return failure(finalPath_.string(), {}, reason);
    }
    const int descriptor = std::exchange(descriptor_, -1);
    if (::close(descriptor) != 0 || ::rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0) {
        const std::string reason = systemReason("cannot be given its name");
        ::unlink(temporaryPath_.c_str());
        return failure(finalPath_.string(), {}, reason);
    }
    syncFolderOf(finalPath_);
    return {};
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return passOn(file);
    if (Result<void> written = file->write(bytes); !written) return written;
    return file->finish();
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view text) {
    return writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Result<void> makeFolder(const std::filesystem::path& path) {
    std::error_code problem;
    std::filesystem::create_directories(path, problem);
    if (problem) return failure(path.string(), {}, "the folder cannot be made: " + problem.message());
    if (!std::filesystem::is_directory(path)) return failure(path.string(), {}, "is not a folder");
    return {};
}

}  // namespace fb
