// What happens in a child process crosses as one line, however the child ends.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>

#include "app/guarded_child.h"

namespace fb {
namespace {

std::string lineOf(const std::function<Result<void>()>& work) {
    const Result<void> done = runGuarded("house.obj", work);
    return done ? "" : done.error().oneLine();
}

TEST(GuardedChild, ThatSucceedsSaysNothing) {
    const pid_t parent = ::getpid();
    EXPECT_EQ(lineOf([parent]() -> Result<void> {
                  return ::getpid() == parent ? failure("", "", "not in a child") : Result<void>();
              }),
              "");
}

TEST(GuardedChild, HandsItsErrorOnWithAllParts) {
    const Result<void> done =
        runGuarded("x", [] { return Result<void>(failure("a.obj", "line 3", "no such vertex", "count from 1")); });
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().file, "a.obj");
    EXPECT_EQ(done.error().place, "line 3");
    EXPECT_EQ(done.error().reason, "no such vertex");
    EXPECT_EQ(done.error().hint, "count from 1");
    EXPECT_EQ(done.error().kind, Error::Kind::failed);
    const Result<void> usage = runGuarded("x", [] { return Result<void>(usageFailure("--up q", "is no axis")); });
    EXPECT_EQ(usage.error().kind, Error::Kind::usage);
}

TEST(GuardedChild, ThatIsKilledIsOneLineWithTheFilesName) {
    const std::string line = lineOf([]() -> Result<void> {
        ::kill(::getpid(), SIGKILL);
        return {};
    });
    EXPECT_EQ(line,
              "house.obj: the process that reads it died: Killed (the file is damaged, hostile or too large for this "
              "machine)");
}

TEST(GuardedChild, ThatThrowsOrRunsOutOfMemorySaysSo) {
    EXPECT_EQ(lineOf([]() -> Result<void> { throw std::runtime_error("broken"); }), "house.obj: broken");
    EXPECT_EQ(lineOf([]() -> Result<void> { throw std::bad_alloc(); }),
              "house.obj: there is not enough memory (split the input into several files)");
}

TEST(GuardedChild, ThatExitsWithoutAWordIsAnError) {
    EXPECT_NE(lineOf([]() -> Result<void> { ::_exit(3); }).find("gave up"), std::string::npos);
}

TEST(GuardedChild, AMessageLongerThanAPipeArrivesWhole) {
    const std::string reason(200000, 'a');
    const Result<void> done = runGuarded("x", [&] { return Result<void>(failure("f", "", reason)); });
    EXPECT_EQ(done.error().reason, reason);
}

}  // namespace
}  // namespace fb
