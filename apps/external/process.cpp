#include "apps/external/process.hpp"

#include "ga/base/stopwatch.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <mutex>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace app {
namespace {

/// Starts a program that leads a group. It runs only after announce(process): if this process is killed
/// before, the child ends. Returns 0 or an error number.
template <class Announce>
int spawn(pid_t& process, std::vector<std::string> words, int in, int out, int err, const std::filesystem::path& folder,
          Announce announce) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    static std::mutex one_at_a_time; // no child holds the pipes of another
    const std::lock_guard lock(one_at_a_time);
    std::array<int, 2> start{-1, -1}, failure{-1, -1};
    const bool has_pipes = pipe2(start.data(), O_CLOEXEC) == 0 && pipe2(failure.data(), O_CLOEXEC) == 0;
    process = has_pipes ? fork() : -1;
    int error = process < 0 ? errno : 0;
    if (process == 0) {
        char begin = 0;
        setpgid(0, 0);
        close(start[1]);
        if (read(start[0], &begin, 1) == 1 && dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
            dup2(err, STDERR_FILENO) >= 0 && (folder.empty() || chdir(folder.c_str()) == 0)) {
            std::signal(SIGPIPE, SIG_DFL);
            execvp(pointers.front(), pointers.data());
        }
        error = errno;
        [[maybe_unused]] const ssize_t told = write(failure[1], &error, sizeof error);
        _exit(127);
    }
    if (process > 0) {
        announce(process);
        [[maybe_unused]] const ssize_t told = write(start[1], "", 1);
        close(failure[1]); // so that nothing is read once the program runs
        if (read(failure[0], &error, sizeof error) > 0) waitpid(process, nullptr, 0);
        failure[1] = -1;
    }
    for (const int end : {start[0], start[1], failure[0], failure[1]}) close(end);
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
        const bool starts =
            nothing >= 0 && pipe2(ends.data(), O_CLOEXEC) == 0 &&
            spawn(process, {"/bin/sh", "-c", supervisor}, ends[0], nothing, nothing, {}, [](pid_t) {}) == 0;
        close(nothing);
        if (!starts) return -1;
        close(ends[0]);
        return ends[1];
    }();
    const std::string line = std::string(1, sign) + " " + std::to_string(group) + "\n";
    [[maybe_unused]] const ssize_t told = write(to_supervisor, line.data(), line.size());
}

} // namespace

int start_process(pid_t& process, std::vector<std::string> words, int in, int out, int err,
                  const std::filesystem::path& folder) {
    tell_supervisor('-', 0); // starts it
    const int error =
        spawn(process, std::move(words), in, out, err, folder, [](pid_t group) { tell_supervisor('+', group); });
    if (error != 0 && process > 0) tell_supervisor('-', process);
    return error;
}

void end_group(pid_t process, int signal) {
    kill(-process, signal);
    if (signal == SIGKILL) tell_supervisor('-', process);
}

bool process_ended_within(double seconds, pid_t process, int& status) {
    for (const ga::Stopwatch clock;;) {
        const pid_t done = waitpid(process, &status, WNOHANG);
        if (done == process || (done < 0 && errno != EINTR)) {
            tell_supervisor('-', process);
            return true;
        }
        if (clock.seconds() > seconds) return false;
        const timespec pause{0, 1'000'000};
        nanosleep(&pause, nullptr);
    }
}

std::string last_line(const std::string& messages) {
    std::istringstream lines(messages);
    std::string line, last;
    while (std::getline(lines, line))
        if (line.find_first_not_of(" ^\t\r") != std::string::npos) last = line;
    return last;
}

} // namespace app
