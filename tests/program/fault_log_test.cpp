// Many faults are few lines.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/fault_log.h"

namespace fb {
namespace {

TEST(FaultLog, SaysTheFirstAtOnceAndTheRestInOneLine) {
    std::vector<std::string> lines;
    FaultLog log([&](const Error& fault) { lines.push_back(fault.oneLine()); });
    for (int i = 0; i < 1000; ++i) log.hear({Error::Kind::failed, "a.pack", {}, "fault " + std::to_string(i), {}});
    // A thousand calls take less than the second within which one line may follow another, or a few lines at most.
    EXPECT_EQ(lines.front(), "a.pack: fault 0");
    EXPECT_LE(lines.size(), 3u);
    log.flush();
    EXPECT_TRUE(lines.back().starts_with("a.pack: fault 999")) << lines.back();
    EXPECT_NE(lines.back().find("more like it)"), std::string::npos) << lines.back();
    const std::size_t said = lines.size();
    log.flush();
    EXPECT_EQ(lines.size(), said) << "nothing was held back";
}

}  // namespace
}  // namespace fb
