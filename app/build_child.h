// Building from the window: `frontbench build` or `frontbench city` runs as a child process, so that no foreign file is
// ever decoded in the workbench's own. Its progress lines and its error come over a pipe.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/result.h"

namespace fb {

class BuildChild {
  public:
    BuildChild() = default;
    ~BuildChild();  // stops the child and waits for it
    BuildChild(const BuildChild&) = delete;
    BuildChild& operator=(const BuildChild&) = delete;

    // Starts this program with `arguments`, to which --progress lines is added.
    [[nodiscard]] Result<void> start(const std::vector<std::string>& arguments);
    [[nodiscard]] bool running() const { return child_ > 0; }
    // Reads what has come; never blocks. Once the child has ended: its result.
    [[nodiscard]] std::optional<Result<void>> poll();
    void cancel();  // asks it to stop; poll() then reports an error

    [[nodiscard]] double fraction() const { return fraction_; }
    [[nodiscard]] const std::string& phase() const { return phase_; }
    [[nodiscard]] double secondsLeft() const;  // negative: not known yet
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  private:
    void readPipe();
    void takeLine(const std::string& line);

    pid_t child_ = -1;
    int pipe_ = -1;
    std::string partial_, phase_, error_;
    std::vector<std::string> notes_;  // what the import dropped or repaired
    double fraction_ = 0.0;
    SteadyClock::time_point start_{};
};

}  // namespace fb
