#include <gtest/gtest.h>

#include "base/folder_lock.h"

namespace fb {
namespace {

TEST(FolderLock, IsHeldByOneAtATime) {
    const auto folder = std::filesystem::temp_directory_path() / "frontbench-lock-test";
    std::filesystem::create_directories(folder);
    {
        const Result<FolderLock> first = FolderLock::take(folder);
        ASSERT_TRUE(first) << first.error().oneLine();
        const Result<FolderLock> second = FolderLock::take(folder);
        ASSERT_FALSE(second);
        EXPECT_NE(second.error().reason.find("another build"), std::string::npos);
    }
    EXPECT_TRUE(FolderLock::take(folder)) << "given up with the first";
    std::filesystem::remove_all(folder);
    EXPECT_FALSE(FolderLock::take(folder));
}

}  // namespace
}  // namespace fb
