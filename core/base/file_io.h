// Files as the reliability rules want them: read with pread into checked buffers (a truncated mapped file would kill
// the reader with SIGBUS), written to a temporary name, synced, renamed, folder synced. A failed sync or close is
// final: the file does not get its name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace fb {

// A file open for reading at any offset; safe to use from several threads.
class FileReader {
  public:
    FileReader() = default;
    ~FileReader();
    FileReader(FileReader&& other) noexcept;
    FileReader& operator=(FileReader&& other) noexcept;

    [[nodiscard]] static Result<FileReader> open(const std::filesystem::path& path);
    [[nodiscard]] std::uint64_t sizeBytes() const { return sizeBytes_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    // Fills `into` from `offset`. Short and interrupted reads are continued; the end of the file is an error.
    [[nodiscard]] Result<void> readAt(std::uint64_t offset, std::span<std::uint8_t> into) const;

  private:
    int descriptor_ = -1;
    std::uint64_t sizeBytes_ = 0;
    std::filesystem::path path_;
};

// The whole file; refused when it is larger than `capBytes`.
[[nodiscard]] Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& path, std::uint64_t capBytes);

// A file under construction: `finish` gives it its final name, the destructor of an unfinished one removes it.
class AtomicFile {
  public:
    AtomicFile() = default;
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;

    [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& finalPath);
    [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes);
    [[nodiscard]] std::uint64_t offset() const { return offset_; }
    [[nodiscard]] Result<void> finish();

  private:
    void discard();

    int descriptor_ = -1;
    std::uint64_t offset_ = 0;
    std::filesystem::path finalPath_, temporaryPath_;
};

[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view text);

// Creates the folder and its parents; an error says which one could not be made.
[[nodiscard]] Result<void> makeFolder(const std::filesystem::path& path);

}  // namespace fb
