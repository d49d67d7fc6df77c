// A replay of three frames whose every summary figure is worked out by hand in summary_json_test.cpp.
#pragma once

#include "measure/report.h"

namespace fb::test {

inline ReplayReport smallReport() {
    ReplayReport report;
    report.version = "0.1.0";
    report.scene = "tiny";
    report.preset = "default";
    report.policy = "lakhia";
    report.path = "walk";
    report.clock = "model";
    report.device = "model device";
    report.sceneHash = 0x1234;
    report.settingsHash = 0xfedcba9876543210;
    report.targetMs = 30.0;
    report.levels = 3;
    report.budgetBytes = 100;
    report.peakBytes = 101;
    report.pinnedBytes = 20;
    report.loads = {.requested = 7,
                    .completed = 5,
                    .cancelled = 1,
                    .failed = 4,
                    .faults = {1, 2, 1},
                    .retried = 2,
                    .givenUp = 1,
                    .evicted = 3,
                    .suspended = 2,
                    .bytes = 4096,
                    .seeks = 6};
    report.prefetch = {.inTime = 3, .late = 2, .lateSeconds = 0.5, .neverDrawn = 1, .wastedBytes = 640,
                       .absentNodeFrames = 11, .reloads = 2, .mostLoadsOfOne = 3};
    report.loadsCsv = "node,level\n";
    report.effects = {{"lighting", "auto", 2, 1.5, 7}};

    FrameRecord a;
    a.frame = 1;
    a.timeSeconds = 0.0;
    a.targetMs = 30.0;
    a.actualMs = 24.0;
    a.estimateMs = 30.0;
    a.moreDetailAvailable = true;
    a.frontNodes = 4;
    a.levels = {1, 1, 2};
    a.triangles = 100;
    a.visited = 10;
    a.togglesUp = 1;
    a.selectUs = 100.0;
    a.residentBytes = 50;
    a.reservedBytes = 10;
    a.budgetBytes = 100;
    a.errorPixelsMax = 4.0;
    a.errorPixelsMean = 1.0;
    a.frontHash = 0x11;

    FrameRecord b = a;
    b.frame = 2;
    b.timeSeconds = 0.5;
    b.actualMs = 36.0;
    b.estimateMs = 27.0;
    b.frontNodes = 2;
    b.levels = {2, 0, 0};
    b.triangles = 300;
    b.visited = 6;
    b.togglesUp = 0;
    b.togglesDown = 1;
    b.pingPongs = 1;
    b.selectUs = 200.0;
    b.residentBytes = 90;
    b.textureBytes = 70;
    b.estimateBytes = 62.5;
    b.reservedBytes = 11;
    b.errorPixelsMax = 10.0;
    b.errorPixelsMean = 3.0;
    b.frontHash = 0x22;

    FrameRecord c = a;
    c.frame = 3;
    c.timeSeconds = 1.0;
    c.actualMs = 30.0;
    c.estimateMs = 33.0;
    c.moreDetailAvailable = false;
    c.frontNodes = 0;
    c.levels = {};
    c.triangles = 200;
    c.visited = 2;
    c.togglesUp = 0;
    c.selectUs = 600.0;
    c.residentBytes = 100;
    c.reservedBytes = 0;
    c.errorPixelsMax = 6.0;
    c.errorPixelsMean = 2.0;
    c.frontHash = 0xabc;

    report.frames = {a, b, c};
    return report;
}

}  // namespace fb::test
