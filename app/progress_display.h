// Progress of long work on standard error: a bar with rate and time left on a terminal, or lines for programs.
#pragma once

#include "app/commands.h"
#include "import/source_scene.h"

namespace fb {

// The returned function must not outlive the work; it answers false once Ctrl-C was pressed.
[[nodiscard]] Progress showProgress(ProgressStyle style);
// Ends the bar's line.
void endProgress(ProgressStyle style);

// A line of ProgressStyle::lines: "progress 0.4213 building". Returns false when it is something else.
bool parseProgressLine(const std::string& line, double& fraction, std::string& phase);

}  // namespace fb
