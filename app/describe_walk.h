// What a walk was, for its report: from the workbench and the records kept of it (design section 7).
#pragma once

#include <string>
#include <vector>

#include "app/workbench.h"
#include "measure/report.h"

namespace fb {

struct WalkNames {
    std::string preset, path;
};
[[nodiscard]] ReplayReport describeWalk(const Workbench& workbench, const WalkNames& names,
                                        std::vector<FrameRecord> records);

}  // namespace fb
