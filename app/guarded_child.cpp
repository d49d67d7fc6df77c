#include "app/guarded_child.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

namespace fb {
namespace {

constexpr rlim_t kWallSeconds = 6 * 3600;
constexpr int kPatienceMs = 900;  // from the wish to stop to the kill
constexpr char kSeparator = '\x1f';

// A signal handler can reach nothing but an object of static storage.
volatile std::sig_atomic_t stopFlag = 0;

void limitThisProcess() {
    const rlim_t cores = std::max(1u, std::thread::hardware_concurrency());
    const rlimit cpu{kWallSeconds * cores, kWallSeconds * cores};
    ::setrlimit(RLIMIT_CPU, &cpu);
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    ::alarm(static_cast<unsigned>(kWallSeconds));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers reserve terabytes of addresses
    const auto bytes = static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
    const rlimit memory{bytes, bytes};
    ::setrlimit(RLIMIT_AS, &memory);
#endif
}

// kind, file, place, reason, hint, separated: the parent's end reads it back with readError.
void sendError(int pipeEnd, const Error& error) {
    std::string text(1, error.kind == Error::Kind::usage ? 'u' : 'f');
    for (const std::string* part : {&error.file, &error.place, &error.reason, &error.hint}) text += kSeparator + *part;
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t put = ::write(pipeEnd, text.data() + done, text.size() - done);
        if (put <= 0) return;
        done += static_cast<std::size_t>(put);
    }
}

// A request to stop is passed on to the child, which stops at a good moment. One that does not come to it within a second
// (a decoder in a loop) is killed: what it has finished is kept.
std::string readAll(int pipeEnd, pid_t child) {
    constexpr int kLookMs = 50;
    std::string text;
    std::array<char, 4096> buffer{};
    int stoppingMs = 0;
    for (;;) {
        pollfd end{pipeEnd, POLLIN, 0};
        const int ready = ::poll(&end, 1, kLookMs);
        if (stopFlag != 0) {
            if (stoppingMs == 0) ::kill(child, SIGTERM);
            stoppingMs += kLookMs;
            if (stoppingMs > kPatienceMs) ::kill(child, SIGKILL);
        }
        if (ready <= 0) continue;
        const ssize_t got = ::read(pipeEnd, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(got));
    }
}

Error readError(const std::string& text) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == kSeparator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    parts.resize(5);
    return {parts[0] == "u" ? Error::Kind::usage : Error::Kind::failed, parts[1], parts[2], parts[3], parts[4]};
}

int runChild(int pipeEnd, const std::function<Result<void>()>& work) {
    limitThisProcess();
    watchForStop();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would hear the answer
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    try {
        const Result<void> done = work();
        if (done) return 0;
        sendError(pipeEnd, done.error());
    } catch (const std::bad_alloc&) {
        sendError(pipeEnd, {Error::Kind::failed, {}, {}, "there is not enough memory", "split the input into several files"});
    } catch (const std::exception& problem) {
        sendError(pipeEnd, {Error::Kind::failed, {}, {}, problem.what(), {}});
    }
    return 1;
}

}  // namespace

void watchForStop() {
    struct sigaction action {};
    action.sa_handler = [](int) { stopFlag = 1; };
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

bool stopWanted() { return stopFlag != 0; }

Result<void> runGuarded(const std::string& what, const std::function<Result<void>()>& work) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return failure({}, {}, std::string("no pipe: ") + std::strerror(errno));
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) return failure({}, {}, std::string("no child process: ") + std::strerror(errno));
    if (child == 0) {
        ::close(ends[0]);
        const int code = runChild(ends[1], work);
        std::fflush(nullptr);
        ::_exit(code);
    }
    ::close(ends[1]);
    // Ctrl-C reaches both; the child stops at a good moment and the parent waits for it.
    watchForStop();
    const std::string text = readAll(ends[0], child);
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (!text.empty()) {
        Error error = readError(text);
        if (error.file.empty()) error.file = what;
        return tl::make_unexpected(std::move(error));
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (stopWanted()) return failure(what, {}, "stopped", "what is finished is kept; run it again to go on from there");
    if (WIFSIGNALED(status)) {
        const char* name = ::strsignal(WTERMSIG(status));
        return failure(what, {}, std::string("the process that reads it died: ") + name,
                       "the file is damaged, hostile or too large for this machine");
    }
    return failure(what, {}, "the process that reads it gave up", "run it again to see whether it recurs");
}

}  // namespace fb
