#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace fb::detail {

void checkFailed(const char* expression, const std::string& sides, const char* file, int line) {
    std::fprintf(stderr, "frontbench: bug: %s is not true (%s) at %s:%d\n", expression, sides.c_str(), file, line);
    std::fflush(stderr);
    std::abort();
}

}  // namespace fb::detail
