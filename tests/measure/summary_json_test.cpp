#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "small_report.h"

namespace fb {
namespace {

using Json = nlohmann::ordered_json;

Json summaryOf(const ReplayReport& report) {
    return Json::parse(summaryJson(report));
}

std::vector<std::string> keysOf(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

TEST(SummaryJson, HasTheNamesOfTheDesignInTheirOrder) {
    const Json json = summaryOf(test::smallReport());
    const std::vector<std::string> names = {
        "program",   "version",       "scene",           "scene_hash",
        "preset",    "settings_hash", "policy",          "path",
        "clock",     "device",        "frames",          "target_ms",
        "actual_ms", "infeasible_frames", "utilisation", "over_target_pct", "estimate_error_pct",
        "toggles",   "levels_share",  "front_nodes",     "triangles",
        "select_us", "visited",       "memory",          "loads", "faults", "prefetch",
        "skipped_roots", "refused",   "err_px",          "effects",       "front_hash"};
    EXPECT_EQ(keysOf(json), names);
    EXPECT_EQ(keysOf(json["actual_ms"]),
              (std::vector<std::string>{"mean", "sd", "p50", "p95", "p99", "max"}));
    EXPECT_EQ(keysOf(json["estimate_error_pct"]), (std::vector<std::string>{"mean", "sd", "robust_sd"}));
    EXPECT_EQ(keysOf(json["toggles"]),
              (std::vector<std::string>{"up", "down", "per_frame", "frames_per_toggle", "pingpong"}));
    EXPECT_EQ(keysOf(json["front_nodes"]), (std::vector<std::string>{"mean", "max"}));
    EXPECT_EQ(keysOf(json["triangles"]), (std::vector<std::string>{"mean", "max"}));
    EXPECT_EQ(keysOf(json["select_us"]), (std::vector<std::string>{"mean", "p99"}));
    EXPECT_EQ(keysOf(json["visited"]), (std::vector<std::string>{"mean", "max"}));
    EXPECT_EQ(keysOf(json["memory"]),
              (std::vector<std::string>{"budget_bytes", "peak_bytes", "over_budget_frames", "pinned_bytes",
                                        "texture_peak_bytes", "estimate_peak_bytes"}));
    EXPECT_EQ(keysOf(json["loads"]), (std::vector<std::string>{"requested", "completed", "suspended",
                                                               "cancelled", "evicted", "bytes", "failed", "seeks"}));
    EXPECT_EQ(keysOf(json["refused"]), (std::vector<std::string>{"groups_mean", "need_ms_mean"}));
    EXPECT_EQ(keysOf(json["err_px"]), (std::vector<std::string>{"mean", "p95", "max"}));
    EXPECT_EQ(keysOf(json["effects"][0]),
              (std::vector<std::string>{"name", "mode", "active_frames", "us_mean", "work"}));
}

TEST(SummaryJson, HasAScorecardOfTheLoads) {
    EXPECT_EQ(summaryOf(test::smallReport())["prefetch"],
              Json::parse(R"({"in_time": 3, "late": 2, "late_s_mean": 0.25, "never_drawn": 1, "wasted_bytes": 640,
                              "absent_node_frames": 11, "reloads": 2, "most_loads_of_one": 3})"));
    EXPECT_TRUE(summaryOf(ReplayReport{})["prefetch"]["late_s_mean"].is_null());
}

TEST(SummaryJson, SaysWhatWasReplayed) {
    const Json json = summaryOf(test::smallReport());
    EXPECT_EQ(json["program"], "frontbench");
    EXPECT_EQ(json["version"], "0.1.0");
    EXPECT_EQ(json["scene"], "tiny");
    EXPECT_EQ(json["scene_hash"], "0000000000001234");
    EXPECT_EQ(json["preset"], "default");
    EXPECT_EQ(json["settings_hash"], "fedcba9876543210");
    EXPECT_EQ(json["policy"], "lakhia");
    EXPECT_EQ(json["path"], "walk");
    EXPECT_EQ(json["clock"], "model");
    EXPECT_EQ(json["device"], "model device");
    EXPECT_EQ(json["frames"], 3);
    EXPECT_EQ(json["target_ms"], 30.0);
    EXPECT_EQ(json["front_hash"], "0000000000000abc");
}

// actual 24, 36, 30: mean 30, sd sqrt((36 + 36 + 0) / 3). Ratios 0.8 and 1.2 count, the third frame had no
// more detail. One frame of three is above 33 ms. Errors -25 %, 25 %, -10 %: mean -10/3, squares of the
// deviations 469.44 + 802.78 + 44.44 = 1316.67, a third of it 438.89.
TEST(SummaryJson, WorksOutTimes) {
    ReplayReport report = test::smallReport();
    report.frames[1].infeasible = true;
    const Json json = summaryOf(report);
    EXPECT_DOUBLE_EQ(json["actual_ms"]["mean"], 30.0);
    EXPECT_DOUBLE_EQ(json["actual_ms"]["sd"], std::sqrt(24.0));
    EXPECT_EQ(json["actual_ms"]["p50"], 30.0);
    EXPECT_EQ(json["actual_ms"]["p95"], 36.0);
    EXPECT_EQ(json["actual_ms"]["p99"], 36.0);
    EXPECT_EQ(json["actual_ms"]["max"], 36.0);
    EXPECT_DOUBLE_EQ(json["utilisation"], 1.0);
    EXPECT_EQ(json["infeasible_frames"], 1);
    EXPECT_DOUBLE_EQ(json["over_target_pct"], 100.0 / 3.0);
    EXPECT_DOUBLE_EQ(json["estimate_error_pct"]["mean"], -10.0 / 3.0);
    EXPECT_NEAR(json["estimate_error_pct"]["sd"], std::sqrt(438.0 + 8.0 / 9.0), 1e-12);
    EXPECT_NEAR(json["estimate_error_pct"]["robust_sd"], 1.4826 * 15.0, 1e-12);  // -25, -10, 25
    EXPECT_DOUBLE_EQ(json["select_us"]["mean"], 300.0);
    EXPECT_EQ(json["select_us"]["p99"], 600.0);
}

// Shares 1/4, 1/4, 1/2 and 1, 0, 0; the third frame drew nothing and has none.
TEST(SummaryJson, WorksOutTheFront) {
    const Json json = summaryOf(test::smallReport());
    EXPECT_EQ(json["levels_share"], Json::parse("[0.625, 0.125, 0.25]"));
    EXPECT_EQ(json["front_nodes"], Json::parse(R"({"mean": 2.0, "max": 4})"));
    EXPECT_EQ(json["triangles"], Json::parse(R"({"mean": 200.0, "max": 300})"));
    EXPECT_EQ(json["visited"], Json::parse(R"({"mean": 6.0, "max": 10})"));
    EXPECT_EQ(json["toggles"]["up"], 1);
    EXPECT_EQ(json["toggles"]["down"], 1);
    EXPECT_DOUBLE_EQ(json["toggles"]["per_frame"], 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(json["toggles"]["frames_per_toggle"], 1.5);
    EXPECT_EQ(json["toggles"]["pingpong"], 1);
    EXPECT_EQ(json["err_px"], Json::parse(R"({"mean": 2.0, "p95": 10.0, "max": 10.0})"));
}

// 60, 101 and 100 bytes of 100: the second frame is over, the third exactly full.
TEST(SummaryJson, WorksOutMemoryLoadsAndEffects) {
    const Json json = summaryOf(test::smallReport());
    EXPECT_EQ(json["memory"],
              Json::parse(R"({"budget_bytes": 100, "peak_bytes": 101, "over_budget_frames": 1, "pinned_bytes": 20,
                              "texture_peak_bytes": 70, "estimate_peak_bytes": 62})"));
    EXPECT_EQ(json["loads"], Json::parse(R"({"requested": 7, "completed": 5, "suspended": 2, "cancelled": 1,
                                             "evicted": 3, "bytes": 4096, "failed": 4, "seeks": 6})"));
    EXPECT_EQ(json["faults"],
              Json::parse(R"({"read": 1, "content": 2, "upload": 1, "retried": 2, "given_up_nodes": 1})"));
    EXPECT_EQ(json["effects"],
              Json::parse(R"([{"name": "lighting", "mode": "auto", "active_frames": 2, "us_mean": 1.5, "work": 7}])"));
}

TEST(SummaryJson, SaysNullWhereThereIsNothingToDivideBy) {
    ReplayReport report = test::smallReport();
    for (FrameRecord& frame : report.frames) {
        frame.moreDetailAvailable = false;
        frame.togglesUp = frame.togglesDown = 0;
        frame.actualMs = 0.0;
    }
    const Json json = summaryOf(report);
    EXPECT_TRUE(json["utilisation"].is_null());
    EXPECT_TRUE(json["toggles"]["frames_per_toggle"].is_null());
    EXPECT_TRUE(json["estimate_error_pct"]["mean"].is_null());
    EXPECT_TRUE(json["estimate_error_pct"]["sd"].is_null());
    EXPECT_TRUE(json["estimate_error_pct"]["robust_sd"].is_null());
    EXPECT_EQ(json["toggles"]["per_frame"], 0.0);
}

TEST(SummaryJson, LeavesFramesWithoutTimeOutOfTheEstimateError) {
    ReplayReport report = test::smallReport();
    report.frames[1].actualMs = 0.0;  // leaves -25 and -10
    EXPECT_DOUBLE_EQ(summaryOf(report)["estimate_error_pct"]["mean"], -17.5);
    EXPECT_DOUBLE_EQ(summaryOf(report)["estimate_error_pct"]["sd"], 7.5);
}

TEST(SummaryJson, OfNoFramesIsStillWhole) {
    ReplayReport report = test::smallReport();
    report.frames.clear();
    const Json json = summaryOf(report);
    EXPECT_EQ(json["frames"], 0);
    EXPECT_EQ(json["over_target_pct"], 0.0);
    EXPECT_EQ(json["toggles"]["per_frame"], 0.0);
    EXPECT_EQ(json["levels_share"], Json::parse("[0.0, 0.0, 0.0]"));
    EXPECT_EQ(json["front_hash"], "0000000000000000");
}

TEST(SummaryJson, TellsOfImagesOnlyWhenAskedFor) {
    ReplayReport report = test::smallReport();
    EXPECT_FALSE(summaryOf(report).contains("image"));
    report.image = ImageErrorSummary{2, 40.0, std::numeric_limits<double>::infinity(), 0.75, 0.5};
    EXPECT_EQ(summaryOf(report)["image"],
              Json::parse(R"({"psnr_db": 40.0, "psnr_db_worst": null, "ssim": 0.75,
                                                          "ssim_worst": 0.5, "pictures": 2})"));
}

TEST(SummaryJson, TakesNamesThatAreNotUtf8) {
    ReplayReport report = test::smallReport();
    report.scene =
        "stra\xdf"
        "e";
    const Json json = summaryOf(report);
    EXPECT_EQ(json["scene"],
              "stra\xef\xbf\xbd"
              "e");  // U+FFFD
}

}  // namespace
}  // namespace fb
