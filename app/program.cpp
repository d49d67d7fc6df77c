#include "app/program.h"

#include <cstdio>

namespace fb {

int runProgram(int, char**) {
    std::puts("frontbench " FB_VERSION);
    return 0;
}

}  // namespace fb
