// Runs the program under test as a user would, with its output in files.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "worlds/scratch_folder.h"

namespace fb::test {

inline std::string readText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

using TemporaryFolder = ScratchFolder;

struct ProgramRun {
    int exitCode = -1;
    std::string out, err;

    [[nodiscard]] std::ptrdiff_t errLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

// `arguments` as typed in a shell. `program` is the one of this build unless another is named.
inline ProgramRun runProgram(const std::string& arguments, const std::string& program = FB_PROGRAM) {
    const TemporaryFolder folder;
    const std::filesystem::path out = folder / "out";
    const std::filesystem::path err = folder / "err";
    const std::string command =
        "'" + program + "' " + arguments + " </dev/null >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, readText(out), readText(err)};
}

}  // namespace fb::test
