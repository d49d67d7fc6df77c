#include "measure/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fb {
namespace {

FrameRecord frame(double actualMs, double estimateMs, std::uint32_t togglesUp, bool moreDetail) {
    FrameRecord f;
    f.targetMs = 20.0;
    f.actualMs = actualMs;
    f.estimateMs = estimateMs;
    f.togglesUp = togglesUp;
    f.pingPongs = togglesUp / 2;
    f.errorPixelsMean = actualMs / 10.0;
    f.skippedRoots = togglesUp;
    f.selectUs = 50.0;
    f.moreDetailAvailable = moreDetail;
    return f;
}

// Utilisation counts the frames that could have been finer: 10 and 30 of 20 ms.
std::vector<ComparedWalk> twoWalks() {
    return {{"greedy", "walk", 20.0, {frame(10, 8, 4, true), frame(20, 16, 0, false), frame(30, 24, 2, true)}},
            {"coarse", "walk", 20.0, {frame(5, 5, 0, false)}},
            {"coarse", "fly", 20.0, {}}};
}

TEST(ComparisonCsv, HasALineAWalk) {
    EXPECT_EQ(comparisonCsv(twoWalks()),
              "policy,path,target_ms,frames,utilisation,p99_over_target,over_target_pct,toggles_per_frame,pingpong,err_px_mean,"
              "skipped_roots,estimate_error_mean_pct,estimate_error_sd_pct,actual_ms_mean,select_us_mean\n"
              "greedy,walk,20,3,1,1.5,33.333333333333336,2,3,2,2,20,0,20,50\n"
              "coarse,walk,20,1,,0.25,0,0,0,0.5,0,0,0,5,50\n"
              "coarse,fly,20,0,,0,0,0,0,0,0,,,0,0\n");
}

TEST(ComparisonTable, HasABlockAPathAndALineAPolicy) {
    const std::string table = comparisonTable(twoWalks());
    EXPECT_NE(table.find("walk, target 20 ms\n"), std::string::npos);
    EXPECT_NE(table.find("\nfly, target 20 ms\n"), std::string::npos);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 8);  // a title and names for each block, three lines, one between
    EXPECT_NE(table.find("greedy                    1.000  1.500   33.3%    2.0000         3     2.00     2.00      50  20.0 +- 0.0\n"),
              std::string::npos)
        << table;
}

}  // namespace
}  // namespace fb
