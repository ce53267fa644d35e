#include "apps/commands/optimise/children.hpp"

#include "apps/external/process.hpp"
#include "domain/errors.hpp"
#include "domain/text/json.hpp"
#include "ga/base/number.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
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

using nlohmann::json;

namespace {

/// As much of a line as a message has room for.
std::string clipped(const std::string& line) {
    constexpr std::size_t most = 120;
    return line.size() <= most ? line : line.substr(0, most) + "...";
}

std::string request(long id, const std::string& genes) {
    return "{\"id\":" + std::to_string(id) + ",\"genes\":" + genes + "}";
}

} // namespace

Children::Children(const std::string& command, int count, double seconds, std::filesystem::path log)
    : text_(command), command_(split_command(command)), seconds_(seconds), log_file_(std::move(log)),
      log_(open(log_file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666)),
      children_(static_cast<std::size_t>(count)) {
    if (log_ < 0)
        throw rough::InputError(log_file_.string() + ": cannot be written, expected a place that can be");
}

Children::~Children() {
    for (Worker& worker : children_)
        if (worker.child)
            worker.child->close_input();
    children_.clear();
    close(log_);
    std::error_code none;
    if (std::filesystem::is_empty(log_file_, none))
        std::filesystem::remove(log_file_, none);
}

std::vector<std::optional<Answer>> Children::ask(std::span<const std::string> genes, const ga::Watch& watch) {
    std::vector<std::optional<Answer>> answers(genes.size());
    std::size_t next = 0, open = 0;
    while (trouble_.empty() && !watch.expired()) {
        for (Worker& worker : children_)
            for (; worker.id == 0 && next < genes.size() && trouble_.empty(); ++next)
                if (genes[next] == first_.genes) {
                    answers[next] = first_.answer;
                } else {
                    begin(worker, next, genes[next]);
                    open += worker.id != 0;
                }
        if (open == 0 || !trouble_.empty())
            break;
        wait();
        for (Worker& worker : children_)
            if (worker.id != 0 && trouble_.empty())
                if (auto answer = hear(worker, genes[worker.call])) {
                    answers[worker.call] = std::move(answer);
                    --open;
                }
    }
    for (Worker& worker : children_)
        if (std::exchange(worker.id, 0) != 0) { // given up: what it would answer is not wanted any more
            worker.child->end();
            worker.child.reset();
        }
    for (std::size_t i = 0; i < genes.size(); ++i)
        if (answers[i])
            record.take({genes[i], *answers[i]});
    return answers;
}

void Children::begin(Worker& worker, std::size_t call, const std::string& genes) {
    try {
        if (!worker.child)
            worker.child = std::make_unique<Child>(command_, log_);
    } catch (const rough::InputError& error) {
        trouble_ = error.what();
        return;
    }
    worker.call = call;
    worker.id = ++asked_;
    worker.since = {};
    worker.child->send(request(worker.id, genes) + "\n");
}

void Children::wait() const {
    constexpr int milliseconds = 50; // until the watch is looked at again
    std::vector<pollfd> places;
    for (const Worker& worker : children_)
        if (worker.id != 0) {
            places.push_back({worker.child->from(), POLLIN, 0});
            if (worker.child->is_sending())
                places.push_back({worker.child->to(), POLLOUT, 0});
        }
    poll(places.data(), places.size(), milliseconds);
}

std::optional<Answer> Children::hear(Worker& worker, const std::string& genes) {
    Child& child = *worker.child;
    child.push();
    const std::string sent = "'" + clipped(text_) + "' was sent " + clipped(request(worker.id, genes));
    const std::string wanted =
        "; expected a line {\"id\":" + std::to_string(worker.id) + ",\"objectives\":[" +
        (objectives() == 0 ? "" : std::to_string(objectives()) + " ") + "finite numbers]}";
    if (const auto line = child.line()) {
        std::string fault;
        auto answer = read(*line, worker.id, fault);
        if (!answer) {
            give_up(sent + " and answered \"" + clipped(*line) + "\" (" + fault + ")" + wanted);
            return std::nullopt;
        }
        if (objectives() == 0) {
            first_ = {genes, *answer};
            record.minimise.resize(objectives());
        }
        worker.id = 0;
        return answer;
    }
    if (child.is_silent()) {
        const std::string part = child.unfinished();
        const std::string how = child.end();
        give_up(sent + " and " + (part.empty() ? "" : "wrote \"" + clipped(part) + "\" and ") + how + wanted +
                log_end());
    } else if (worker.since.seconds() > seconds_) {
        give_up(sent + " and was silent for " + ga::number(seconds_) + " s" + wanted +
                " within --timeout, flushed" + log_end());
    }
    return std::nullopt;
}

std::optional<Answer> Children::read(const std::string& line, long id, std::string& fault) const {
    try {
        const json j = rough::parsed_json(line, "line");
        if (!j.is_object() || !j.contains("id") || !j.contains("objectives")) {
            fault = "no object with id and objectives";
            return std::nullopt;
        }
        if (j["id"] != id) {
            fault = "another id";
            return std::nullopt;
        }
        Answer answer{j["objectives"].get<std::vector<double>>(), violation_from(j)};
        const auto finite = [](const std::vector<double>& values) {
            return std::all_of(values.begin(), values.end(),
                               [](double value) { return std::isfinite(value); });
        };
        if (answer.objectives.empty() || (objectives() != 0 && answer.objectives.size() != objectives()))
            fault = std::to_string(answer.objectives.size()) + " objectives";
        else if (!first_.genes.empty() && answer.violation.size() != first_.answer.violation.size())
            fault = std::to_string(answer.violation.size()) + " violations, " +
                    std::to_string(first_.answer.violation.size()) + " in the first answer";
        else if (!finite(answer.objectives) || !finite(answer.violation))
            fault = "not finite";
        else
            return answer;
    } catch (const rough::InputError&) {
        fault = "not JSON";
    } catch (const json::exception&) {
        fault = "not numbers";
    }
    return std::nullopt;
}

void Children::give_up(const std::string& message) { trouble_ = "--evaluate: " + message; }

std::string Children::log_end() const {
    std::ifstream in(log_file_);
    std::string line, last;
    while (std::getline(in, line))
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            last = line;
    return last.empty() ? "" : "; " + log_file_.string() + " ends with \"" + clipped(last) + "\"";
}

} // namespace app
