// The plots of a replay, after the figures of thesis ch. 6: time against the target (6.5), levels of the
// front (6.2, 6.3 and figure 7 of the paper), accuracy of the estimate with v_time (6.4), toggles (6.6),
// memory (6.1) and, beyond the thesis, the error in pixels. A report comes in; named figures go to the
// writers of drawing.h.
#pragma once

#include "measure/figure.h"
#include "measure/report.h"

namespace fb {

struct NamedFigure {
    std::string name;  // of the files: "time" for plots/time.png and plots/time.svg
    Figure figure;
};

[[nodiscard]] std::vector<NamedFigure> replayFigures(const ReplayReport& report);

}  // namespace fb
