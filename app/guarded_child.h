// Foreign files are decoded in a child process with limits on memory, CPU and wall time (reliability rule 1): whatever a
// reader does with a hostile file, the parent answers with one line.
#pragma once

#include <functional>
#include <string>

#include "base/result.h"

namespace fb {

// Runs `work` in a forked child and waits. `work` returns an error to be told; the error crosses as text. `what` names
// the files for the line that is said when the child dies. Must be called while the process has one thread.
[[nodiscard]] Result<void> runGuarded(const std::string& what, const std::function<Result<void>()>& work);

// True after Ctrl-C (SIGINT) or SIGTERM, once watchForStop() has been called: work stops at the next progress call.
void watchForStop();
[[nodiscard]] bool stopWanted();

}  // namespace fb
