// The program's entry behind main(): command line in, exit code out (0 done, 1 failed, 2 wrong usage).
#pragma once

namespace fb {

int runProgram(int argumentCount, char** arguments);

}  // namespace fb
