#include "app/calibration.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "app/counted.h"
#include "settings/knob_table.h"

namespace fb {
namespace {

constexpr TimingPlan kRounds{9, 25, 20.0, false};
constexpr double kQuiet = 1.15;  // disturbance of a machine that does nothing else: below

std::string number(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// What is measured to some per cent is written with four digits.
double fourDigits(double value) { return std::strtod(number("%.4g", value).c_str(), nullptr); }

// The constants one after the other into settings: each later one counts in the units of those before.
class Taking {
  public:
    Taking(Settings& settings, Calibration& into) : settings_(settings), into_(into) {}

    void take(const char* path, double value, std::string spread) {
        const Knob& knob = *findKnob(path);
        const double before = knob.get(settings_);
        const Result<void> admitted = admit(settings_, knob, value, "calibrate");
        if (!admitted) return keep(path, admitted.error().reason + ", " + admitted.error().hint);
        into_.constants.push_back({path, value, before, std::move(spread), {}});
    }
    void takeMeasured(const char* path, const std::optional<Estimate>& estimate, const char* whyNot) {
        if (!estimate) return keep(path, whyNot);
        take(path, fourDigits(estimate->value), "+- " + number("%.2g", estimate->plusMinus));
    }
    void keep(const char* path, std::string why) {
        const double before = findKnob(path)->get(settings_);
        into_.constants.push_back({path, before, before, {}, std::move(why)});
    }

  private:
    Settings& settings_;
    Calibration& into_;
};

void takeMemory(const Workbench& w, Taking& taking) {
    const BytesPerCost bytes = bytesPerCost(w.scene->hierarchy, w.settings.select.cTextured);
    taking.take("load.c_memory", fourDigits(bytes.mean),
                number("%.4g", bytes.p5) + " .. " + number("%.4g", bytes.p95) + " in 90 % of " +
                    counted(w.scene->hierarchy.size(), "node"));
}

// The time of either kind of triangle is a knob of the simulated device: nothing is to be fitted.
void askModel(Workbench& w, Calibration& calibration) {
    Taking taking(w.settings, calibration);
    const double both = w.settings.model.texturedUs + w.settings.model.untexturedUs;
    if (w.sceneFacts.texturedTriangles == 0) {
        taking.keep("select.c_textured", "the scene has no textured triangle");
    } else if (!(both > 0.0)) {
        taking.keep("select.c_textured", "triangles take no time");
    } else {
        taking.take("select.c_textured", w.settings.model.texturedUs / both, "exact");
    }
    takeMemory(w, taking);
    calibrateByModel(w);
    taking.take("control.v_time_start", w.control.measured.vTimeMs, "exact");
    taking.take("control.overhead", w.control.measured.overheadMs, "exact");
    taking.take("control.fill", w.control.measured.fillMsPerMegapixel, "exact");
    calibration.facts.push_back("device: simulated (model clock)");
}

Result<void> measureDevice(Workbench& w, glm::ivec2 size, const Progress& progress, Calibration& calibration) {
    Result<CalibrationFronts> fronts = makeCalibrationFronts(w, size, progress);
    if (!fronts) return passOn(fronts);
    TimingPlan plan = kRounds;
    plan.withoutTextures = w.effects[Effect::texturing] && w.sceneFacts.texturedTriangles > 0;
    Result<std::vector<FrontTimes>> times = timeFronts(w, fronts->timed, plan, progress);
    if (!times) return passOn(times);

    Taking taking(w.settings, calibration);
    taking.takeMeasured("select.c_textured", fitCTextured(*times),
                        w.sceneFacts.texturedTriangles == 0     ? "the scene has no textured triangle"
                        : !plan.withoutTextures ? "effects.texturing is off"
                                                : "more triangles did not take more time");
    takeMemory(w, taking);
    countCosts(w, fronts->timed, *times);
    taking.takeMeasured("control.v_time_start", fitVTime(*times), "more triangles did not take more time");
    taking.takeMeasured("control.overhead", fitOverhead(*times), "nothing was drawn");
    taking.takeMeasured("control.fill", fitFill(*times), "filling did not show");

    const double disturbed = disturbance(*times);
    calibration.facts.push_back("disturbance: the median time of a picture is " + number("%.2f", disturbed) +
                                " times the tenth percentile");
    if (disturbed > kQuiet) {
        calibration.warning = "the machine was busy: the median time of a picture is " + number("%.2f", disturbed) +
                              " times its tenth percentile; times of an idle machine may lie below the uncertainties";
    }
    std::uint64_t most = 0;
    for (const FrontTimes& front : *times) most = std::max(most, front.texturedTriangles + front.untexturedTriangles);
    calibration.facts.push_back("device: " + w.renderer->deviceName());
    calibration.facts.push_back("picture: " + std::to_string(size.x) + "x" + std::to_string(size.y));
    calibration.facts.push_back(
        "timed: " + counted(times->front().ms.size(), "round") + " of " + counted(times->size(), "front") + " in " +
        counted(fronts->timed.views.size(), "view") + ", " +
        (fronts->repeats ? "one level drawn once and repeatedly" : counted(fronts->levels, "level")) + ", up to " +
        counted(most, "triangle"));
    return {};
}

}  // namespace

Result<Calibration> measureConstants(Workbench& w, glm::ivec2 size, const Progress& progress) {
    Calibration calibration;
    if (w.clock == ClockKind::model) {
        askModel(w, calibration);
    } else if (Result<void> measured = measureDevice(w, size, progress, calibration); !measured) {
        return passOn(measured);
    }
    calibration.facts.push_back("scene: " + w.scene->info.name + ", " + counted(w.scene->hierarchy.rootCount, "block") +
                                ", " + counted(w.scene->hierarchy.size(), "node") + ", leaves of " +
                                counted(w.sceneFacts.texturedTriangles, "textured triangle") + " and " +
                                std::to_string(w.sceneFacts.untexturedTriangles) + " untextured");
    return calibration;
}

}  // namespace fb
