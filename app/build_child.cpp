#include "app/build_child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "app/progress_display.h"

extern char** environ;

namespace fb {

BuildChild::~BuildChild() {
    if (child_ > 0) {
        ::kill(child_, SIGTERM);
        // It gives its own child a second.
        for (int tries = 0; tries < 60 && ::waitpid(child_, nullptr, WNOHANG) == 0; ++tries) ::usleep(50'000);
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    if (pipe_ >= 0) ::close(pipe_);
}

Result<void> BuildChild::start(const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return failure({}, {}, std::string("no pipe: ") + std::strerror(errno));
    std::error_code unreadable;
    const std::string program = std::filesystem::read_symlink("/proc/self/exe", unreadable).string();
    std::vector<std::string> texts = {program};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    texts.insert(texts.end(), {"--progress", "lines"});
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int problem = ::posix_spawn(&child_, program.c_str(), &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (problem != 0) {
        ::close(ends[0]);
        child_ = -1;
        return failure(program, {}, std::string("cannot be started: ") + std::strerror(problem));
    }
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = ends[0];
    ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
    partial_.clear();
    error_.clear();
    notes_.clear();
    phase_ = "starting";
    fraction_ = 0.0;
    start_ = SteadyClock::now();
    return {};
}

void BuildChild::takeLine(const std::string& line) {
    constexpr std::string_view kErrorHead = "frontbench: ";
    constexpr std::string_view kNoteHead = "note: ";
    if (parseProgressLine(line, fraction_, phase_)) return;
    if (line.starts_with(kErrorHead)) error_ = line.substr(kErrorHead.size());
    if (line.starts_with(kNoteHead)) notes_.push_back(line.substr(kNoteHead.size()));
}

void BuildChild::readPipe() {
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::read(pipe_, buffer.data(), buffer.size())) > 0;) {
        partial_.append(buffer.data(), static_cast<std::size_t>(got));
    }
    for (std::size_t end = 0; (end = partial_.find('\n')) != std::string::npos;) {
        takeLine(partial_.substr(0, end));
        partial_.erase(0, end + 1);
    }
}

std::optional<Result<void>> BuildChild::poll() {
    if (child_ <= 0) return std::nullopt;
    readPipe();
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) != child_) return std::nullopt;
    child_ = -1;
    readPipe();  // what it wrote between the two calls above
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return Result<void>{};
    if (!error_.empty()) return failure({}, {}, error_);
    if (WIFSIGNALED(status)) {
        return failure({}, {}, std::string("the build died: ") + ::strsignal(WTERMSIG(status)),
                       "what is finished is kept; opening the same files again goes on from there");
    }
    return failure({}, {}, "the build ended without a word", "run `frontbench build` in a terminal to see more");
}

void BuildChild::cancel() {
    if (child_ > 0) ::kill(child_, SIGTERM);
}

double BuildChild::secondsLeft() const {
    if (fraction_ < 0.01) return -1.0;
    return millisecondsSince(start_) / 1000.0 * (1.0 - fraction_) / fraction_;
}

}  // namespace fb
