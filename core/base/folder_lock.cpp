#include "base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace fb {

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return failure(folder.string(), {}, std::strerror(errno));
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return FolderLock(file);
    const bool held = errno == EWOULDBLOCK;
    ::close(file);
    // Some file systems have no locks: there, going on is better than refusing.
    if (!held) return FolderLock(-1);
    return failure(folder.string(), {}, "another build is writing into this folder", "wait for it or choose another folder");
}

FolderLock::~FolderLock() {
    if (file_ >= 0) ::close(file_);
}

}  // namespace fb
