#include <gtest/gtest.h>

#include <limits>

#include "small_report.h"

namespace fb {
namespace {

// The columns as the design prints them, with its "level0,…,levelN" written out by levelNames.
std::string designHeader(int levels) {
    std::string names;
    for (int level = 0; level < levels; ++level) names += "level" + std::to_string(level) + ",";
    return "frame,t_s,dt_ms,cam_x,cam_y,cam_z,speed_mps,target_ms,actual_ms,estimate_ms,overhead_ms,v_time,"
           "share_ms,"
           "front_nodes," +
           names +
           "triangles,visited,toggles_up,toggles_down,pingpong,select_us,upload_bytes,resident_bytes,budget_"
           "bytes,"
           "pending_loads,evictions,err_px_max,err_px_mean,bound_by_time,bound_by_load,bound_by_hysteresis,"
           "bound_by_leaf,bound_by_memory,front_hash,bound_by_view,bound_by_policy,refused_groups,"
           "refused_need_ms,skipped_roots,fixed_ms,reserved_bytes,texture_bytes,estimate_bytes\n";
}

TEST(FramesCsv, HasTheColumnsOfTheDesign) {
    ReplayReport report;
    for (int levels : {1, 3, kMaxLevels}) {
        report.levels = levels;
        EXPECT_EQ(framesCsv(report), designHeader(levels));
    }
}

TEST(FramesCsv, HasAtLeastOneLevelAndAtMostAllThatAreCounted) {
    ReplayReport report;
    report.levels = 0;
    EXPECT_EQ(framesCsv(report), designHeader(1));
    report.levels = kMaxLevels + 1;
    EXPECT_EQ(framesCsv(report), designHeader(kMaxLevels));
}

TEST(FramesCsv, WritesEachValueUnderItsName) {
    FrameRecord f;
    f.frame = 1;
    f.timeSeconds = 2.5;
    f.dtMs = 33.25;
    f.eye = {4.0, -5.5, 6.0};
    f.speedMetresPerSecond = 7.0;
    f.targetMs = 8.0;
    f.actualMs = 9.125;
    f.estimateMs = 10.0;
    f.overheadMs = 11.0;
    f.vTimeMs = 0.00001;
    f.shareMs = 13.0;
    f.frontNodes = 14;
    f.levels = {15, 16, 99};
    f.triangles = 17000000000;
    f.visited = 18;
    f.togglesUp = 19;
    f.togglesDown = 20;
    f.pingPongs = 21;
    f.selectUs = 0.1;
    f.uploadBytes = 23;
    f.residentBytes = 24;
    f.reservedBytes = 41;
    f.budgetBytes = 25;
    f.pendingLoads = 26;
    f.evictions = 27;
    f.errorPixelsMax = 28.0;
    f.errorPixelsMean = 29.0;
    f.boundBy[static_cast<std::size_t>(BoundBy::time)] = 30;
    f.boundBy[static_cast<std::size_t>(BoundBy::load)] = 31;
    f.boundBy[static_cast<std::size_t>(BoundBy::hysteresis)] = 32;
    f.boundBy[static_cast<std::size_t>(BoundBy::leaf)] = 33;
    f.boundBy[static_cast<std::size_t>(BoundBy::memory)] = 34;
    f.boundBy[static_cast<std::size_t>(BoundBy::view)] = 35;
    f.boundBy[static_cast<std::size_t>(BoundBy::policy)] = 36;
    f.refusedGroups = 37;
    f.refusedNeedMs = 38.5;
    f.skippedRoots = 39;
    f.fixedMs = 40.25;
    f.textureBytes = 42;
    f.estimateBytes = 43.5;
    f.frontHash = 0xdeadbeef00c0ffee;
    ReplayReport report;
    report.levels = 2;
    report.frames = {f};
    EXPECT_EQ(framesCsv(report),
              designHeader(2) +
                  "1,2.5,33.25,4,-5.5,6,7,8,9.125,10,11,1e-05,13,14,15,16,17000000000,18,19,20,21,"
                  "0.1,23,24,25,26,27,28,29,30,31,32,33,34,deadbeef00c0ffee,35,36,37,38.5,39,40.25,41,42,43.5\n");
}

TEST(FramesCsv, LeavesTheFieldEmptyWhereTheNumberIsNotFinite) {
    FrameRecord f;
    f.actualMs = std::numeric_limits<double>::quiet_NaN();
    f.estimateMs = std::numeric_limits<double>::infinity();
    f.errorPixelsMean = -std::numeric_limits<double>::infinity();
    ReplayReport report;
    report.frames = {f};
    EXPECT_EQ(framesCsv(report), designHeader(1) +
                                     "0,0,0,0,0,0,0,0,,,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,,0,0,0,0,0,"
                                     "0000000000000000,0,0,0,0,0,0,0,0,0\n");
}

TEST(FramesCsv, WritesNumbersThatReadBackAsThemselves) {
    ReplayReport report = test::smallReport();
    report.frames.resize(1);
    report.frames[0].timeSeconds = 1.0 / 3.0;
    const std::string text = framesCsv(report);
    const std::size_t start = text.find("\n1,") + 3;
    EXPECT_EQ(std::stod(text.substr(start, text.find(',', start) - start)), 1.0 / 3.0);
}

}  // namespace
}  // namespace fb
