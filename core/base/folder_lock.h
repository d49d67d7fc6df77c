// One writer a folder: held while a scene is built into it, given up by the system when the process ends, however it does.
#pragma once

#include <filesystem>
#include <utility>

#include "base/result.h"

namespace fb {

class FolderLock {
  public:
    // Errors: another process holds it; the folder cannot be opened.
    [[nodiscard]] static Result<FolderLock> take(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    FolderLock& operator=(FolderLock&&) = delete;

  private:
    explicit FolderLock(int file) : file_(file) {}
    int file_;
};

}  // namespace fb
