#include "apps/external/process.hpp"

#include "ga/base/stopwatch.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace app {

namespace {

int spawn(pid_t& process, std::vector<std::string> words, int in, int out, int err) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, err, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int error = posix_spawnp(&process, pointers.front(), &files, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

/// Reads "+ GROUP" and "- GROUP". When its input ends, it kills the groups that were added and not removed.
/// It leads a group, so no signal of the terminal reaches it.
constexpr const char* supervisor = R"(trap '' INT TERM HUP
all=' '
while read -r sign group; do
    case $sign in
        +) all="$all-$group " ;;
        -) case $all in *" -$group "*) all="${all%%" -$group "*} ${all#*" -$group "}" ;; esac ;;
    esac
done
[ "$all" = ' ' ] || kill -s KILL -- $all)";

/// Tells the supervisor, which the first call starts.
void tell_supervisor(char sign, pid_t group) {
    static const int to_supervisor = [] {
        std::array<int, 2> ends{};
        const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
        pid_t process = 0;
        const bool starts = nothing >= 0 && pipe2(ends.data(), O_CLOEXEC) == 0 &&
                            spawn(process, {"/bin/sh", "-c", supervisor}, ends[0], nothing, nothing) == 0;
        close(nothing);
        if (!starts)
            return -1;
        close(ends[0]);
        return ends[1];
    }();
    const std::string line = std::string(1, sign) + " " + std::to_string(group) + "\n";
    [[maybe_unused]] const ssize_t told = write(to_supervisor, line.data(), line.size());
}

} // namespace

int start_process(pid_t& process, std::vector<std::string> words, int in, int out, int err) {
    const int error = spawn(process, std::move(words), in, out, err);
    if (error == 0)
        tell_supervisor('+', process);
    return error;
}

void end_group(pid_t process, int signal) {
    kill(-process, signal);
    if (signal == SIGKILL)
        tell_supervisor('-', process);
}

bool process_ended_within(double seconds, pid_t process, int& status) {
    for (const ga::Stopwatch clock;;) {
        const pid_t done = waitpid(process, &status, WNOHANG);
        if (done == process || (done < 0 && errno != EINTR)) {
            tell_supervisor('-', process);
            return true;
        }
        if (clock.seconds() > seconds)
            return false;
        const timespec pause{0, 1'000'000};
        nanosleep(&pause, nullptr);
    }
}

std::string last_line(const std::string& messages) {
    std::istringstream lines(messages);
    std::string line, last;
    while (std::getline(lines, line))
        if (line.find_first_not_of(" ^\t\r") != std::string::npos)
            last = line;
    return last;
}

} // namespace app
