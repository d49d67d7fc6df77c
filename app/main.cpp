#include "app/program.h"

int main(int argumentCount, char** arguments) { return fb::runProgram(argumentCount, arguments); }
