#include "apps/commands/optimise/child.hpp"

#include "apps/external/process.hpp"
#include "domain/errors.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace app {

namespace {

constexpr std::size_t longest_line = 16'000'000;
constexpr double patience = 2; ///< seconds for a child to end by itself

struct Pipe {
    int read = -1, write = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw rough::InputError("--evaluate: no pipe to be had (" + std::string(std::strerror(errno)) +
                                    "), expected fewer --threads");
        read = ends[0], write = ends[1];
    }
};

void close_once(int& descriptor) {
    if (descriptor >= 0)
        close(std::exchange(descriptor, -1));
}

} // namespace

Words split_command(const std::string& command) {
    Words words;
    bool inside = false; // of a word
    char quote = 0;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        const bool last = i + 1 == command.size();
        if (quote == 0 && std::strchr(" \t\n", c)) {
            inside = false;
            continue;
        }
        if (!std::exchange(inside, true))
            words.emplace_back();
        if (quote == 0 && (c == '\'' || c == '"'))
            quote = c;
        else if (c == quote)
            quote = 0;
        else if (c == '\\' && !last && (quote == 0 || (quote == '"' && std::strchr("\"\\", command[i + 1]))))
            words.back() += command[++i];
        else
            words.back() += c;
    }
    if (quote != 0)
        throw rough::InputError("--evaluate: a " + std::string(1, quote) + " is left open in \"" + command +
                                "\", expected another to close it");
    if (words.empty() || words.front().empty())
        throw rough::InputError("--evaluate: \"" + command +
                                "\" given, expected a program with its arguments");
    return words;
}

Child::Child(const Words& command, int log) {
    Pipe in;
    Pipe out;
    const int error = start_process(process_, command, in.read, out.write, log);
    close(in.read);
    close(out.write);
    in_ = in.write;
    out_ = out.read;
    if (error != 0) {
        close_once(in_);
        close_once(out_);
        throw rough::InputError("--evaluate: '" + command.front() + "' cannot be started (" +
                                std::strerror(error) + "), expected a program");
    }
    fcntl(in_, F_SETFL, O_NONBLOCK);
    fcntl(out_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
    close_input();
    ended_within(patience);
    end();
    close_once(out_);
}

void Child::close_input() { close_once(in_); }

void Child::send(const std::string& lines) {
    rest_ += lines;
    push();
}

void Child::push() {
    while (!rest_.empty()) {
        const ssize_t written = write(in_, rest_.data(), rest_.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0 && errno == EAGAIN)
            return;
        rest_.erase(0, written < 0 ? rest_.size() : static_cast<std::size_t>(written));
    }
}

std::optional<std::string> Child::line() {
    std::array<char, 65536> some;
    for (std::size_t end; !silent_ || read_.find('\n') != std::string::npos;) {
        if ((end = read_.find('\n')) != std::string::npos) {
            std::string line = read_.substr(0, end);
            read_.erase(0, end + 1);
            return line;
        }
        const ssize_t size = read(out_, some.data(), some.size());
        if (size < 0 && errno == EINTR)
            continue;
        if (size < 0 && errno == EAGAIN)
            return std::nullopt;
        if (size <= 0 || read_.size() > longest_line)
            silent_ = true;
        else
            read_.append(some.data(), static_cast<std::size_t>(size));
    }
    return std::nullopt;
}

bool Child::ended_within(double seconds) {
    if (!ended_ && process_ > 0)
        ended_ = process_ended_within(seconds, process_, status_);
    return ended_;
}

std::string Child::end() {
    if (process_ <= 0)
        return {};
    const bool by_itself =
        ended_within(silent_ ? 0.2 : 0); // a program's output closes a little before it ends
    kill(-process_, SIGKILL);
    if (!ended_)
        waitpid(process_, &status_, 0);
    process_ = 0;
    if (!by_itself)
        return "closed its output";
    return WIFEXITED(status_) ? "ended with exit code " + std::to_string(WEXITSTATUS(status_))
                              : "was ended by signal " + std::to_string(WTERMSIG(status_));
}

} // namespace app
