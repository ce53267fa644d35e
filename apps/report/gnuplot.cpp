#include "apps/report/gnuplot.hpp"

#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <spawn.h>
#include <sstream>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace app {

namespace {

/// A file in memory that a child may read or write as its standard stream.
class MemoryFile {
  public:
    MemoryFile() : file_(memfd_create("rugosa", MFD_CLOEXEC)) {
        if (file_ < 0)
            throw rough::InputError("pictures: the system gives no file in memory, expected one to draw in");
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;

    int get() const { return file_; }
    std::string content() const { return rough::read_whole("/proc/self/fd/" + std::to_string(file_)); }
    void fill(std::string_view content) const {
        while (!content.empty()) {
            const ssize_t written = write(file_, content.data(), content.size());
            if (written < 0 && errno != EINTR)
                throw rough::InputError("pictures: no memory to draw in");
            content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
        }
        lseek(file_, 0, SEEK_SET);
    }

  private:
    int file_;
};

/// What a child starts with: its streams, a process group of its own so that all of it can be ended, and the
/// signals as the system has them.
class Start {
  public:
    Start(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
        posix_spawn_file_actions_init(&files_);
        posix_spawn_file_actions_adddup2(&files_, in.get(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&files_, out.get(), STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files_, err.get(), STDERR_FILENO);
        posix_spawnattr_init(&how_);
        sigset_t usual;
        sigemptyset(&usual);
        sigaddset(&usual, SIGPIPE);
        posix_spawnattr_setsigdefault(&how_, &usual);
        posix_spawnattr_setflags(&how_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    }
    ~Start() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&how_);
    }
    Start(const Start&) = delete;

    /// 0, or the error
    int run(pid_t& child, const char* program, char* const* words) const {
        return posix_spawnp(&child, program, &files_, &how_, words, environ);
    }

  private:
    posix_spawn_file_actions_t files_;
    posix_spawnattr_t how_;
};

/// Waits for a child and gives its status; after so many seconds ends it and all that it started, and gives
/// nothing.
bool ended_within(double seconds, pid_t child, int& status) {
    const ga::Stopwatch clock;
    for (;;) {
        const pid_t done = waitpid(child, &status, WNOHANG);
        if (done == child)
            return true;
        if ((done < 0 && errno != EINTR) || clock.seconds() > seconds) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            return false;
        }
        const timespec pause{0, 2'000'000};
        nanosleep(&pause, nullptr);
    }
}

/// The last line of a complaint that is more than a mark under the place.
std::string told(const std::string& complaint) {
    std::istringstream lines(complaint);
    std::string line, last;
    while (std::getline(lines, line))
        if (line.find_first_not_of(" ^\t") != std::string::npos)
            last = line;
    return last;
}

} // namespace

Drawn run_gnuplot(const std::string& script, double seconds) {
    const MemoryFile in, out, err;
    in.fill(script);
    const Start start(in, out, err);
    std::array<char, 8> program{"gnuplot"};
    std::array<char, 3> no_start_up_file{"-d"};
    const std::array<char*, 3> words{program.data(), no_start_up_file.data(), nullptr};
    pid_t child = 0;
    if (start.run(child, program.data(), words.data()) != 0)
        return {"", "it is not to be found"};
    int status = 0;
    if (!ended_within(seconds, child, status))
        return {"", "it was not done in time"};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return {"", told(err.content())};
    return {out.content(), ""};
}

std::string gnuplot_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            result += ' ';
        else if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '`')
            result += "\\140\".\""; // by its number, which a digit behind it would change
        else
            result += c;
    return result + "\"";
}

} // namespace app
