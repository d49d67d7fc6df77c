// What the driver says: the error flag after a call that may fail, and the debug messages of a debug context.
// In: the current context. Out: text. The flag goes into Result errors; the messages are read by tests, which
// fail on any that reports an error, and by debug builds of the program.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace fb {

// Empties the error flags before a call whose own error is of interest.
void clearGlErrors();
// Error: "the driver is out of memory while making a mesh page". Empties the flags.
[[nodiscard]] Result<void> takeGlError(const std::string& while_);

// Collects debug messages while it lives; at most one listener a context at a time.
class GlMessages {
  public:
    GlMessages();
    ~GlMessages();
    GlMessages(const GlMessages&) = delete;
    GlMessages& operator=(const GlMessages&) = delete;

    // False where the context sends none (not a debug context).
    [[nodiscard]] bool listening() const { return listening_; }
    // Errors, undefined behaviour and whatever the driver calls grave; performance hints and notes are left
    // out.
    [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
    void forget() { errors_.clear(); }
    void add(std::string error) { errors_.push_back(std::move(error)); }

  private:
    bool listening_ = false;
    std::vector<std::string> errors_;
};

}  // namespace fb
