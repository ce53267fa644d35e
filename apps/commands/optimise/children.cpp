#include "apps/commands/optimise/children.hpp"

#include "apps/external/process.hpp"
#include "domain/text/json.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <regex>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace app {
namespace {

constexpr std::size_t longest_line = 16'000'000, max_objectives = 1000;
/// Bytes of standard error after which only the last ones are kept.
constexpr off_t max_log = 10'000'000, kept_log = 100'000;

/// The ends of a new pipe: to read from, to write to.
std::array<int, 2> new_pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        rough::refuse("--evaluate: a pipe cannot be opened (", std::strerror(errno), "); use fewer --threads");
    return ends;
}

void close_once(int& descriptor) {
    if (descriptor >= 0) close(std::exchange(descriptor, -1));
}

/// The beginning of a line, for a message.
std::string clipped(const std::string& line) {
    constexpr std::size_t longest = 120;
    return line.size() <= longest ? line : line.substr(0, longest) + "...";
}

} // namespace

Words split_command(const std::string& command) {
    Words words;
    bool inside = false; // whether in a word
    char quote = 0;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        const bool last = i + 1 == command.size();
        if (quote == 0 && std::strchr(" \t\n", c)) {
            inside = false;
            continue;
        }
        if (!std::exchange(inside, true)) words.emplace_back();
        if (quote == 0 && (c == '\'' || c == '"'))
            quote = c;
        else if (c == quote)
            quote = 0;
        else if (c == '\\' && !last && (quote == 0 || (quote == '"' && std::strchr("\"\\", command[i + 1]))))
            words.back() += command[++i];
        else
            words.back() += c;
    }
    if (quote != 0) rough::refuse("--evaluate: a ", quote, " is left open in \"", command, "\"; close it");
    if (words.empty() || words.front().empty())
        rough::refuse("--evaluate: \"", command, "\" given; give a program with its arguments");
    return words;
}

Child::Child(const Words& command, int log) {
    const auto [their_in, in] = new_pipe();
    const auto [out, their_out] = new_pipe();
    const int error = start_process(process_, command, their_in, their_out, log);
    close(their_in);
    close(their_out);
    in_ = in;
    out_ = out;
    if (error != 0) {
        close_once(in_);
        close_once(out_);
        rough::refuse("--evaluate: '", command.front(), "' cannot be started (", std::strerror(error),
                      "); name a program");
    }
    fcntl(in_, F_SETFL, O_NONBLOCK);
    fcntl(out_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
    close_input();
    end(2);
    close_once(out_);
}

void Child::close_input() { close_once(in_); }

std::optional<std::string> Child::answer(const std::string& line, double seconds, const std::function<bool()>& stops) {
    constexpr int milliseconds = 50; // between two looks at the clock and at `stops`
    const auto waits = [](ssize_t size) { return size < 0 && (errno == EINTR || errno == EAGAIN); };
    std::array<char, 65536> part;
    std::string rest = line + "\n";
    for (const ga::Stopwatch clock;;) {
        if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
            std::string whole = read_.substr(0, end);
            read_.erase(0, end + 1);
            return whole;
        }
        if (silent_ || clock.seconds() > seconds || stops()) return std::nullopt;
        std::array<pollfd, 2> places{{{out_, POLLIN, 0}, {rest.empty() ? -1 : in_, POLLOUT, 0}}};
        poll(places.data(), places.size(), milliseconds);
        if (const ssize_t size = write(in_, rest.data(), rest.size()); size >= 0)
            rest.erase(0, static_cast<std::size_t>(size));
        else if (!waits(size))
            rest.clear(); // the child has closed its input
        const ssize_t size = read(out_, part.data(), part.size());
        if (size > 0) read_.append(part.data(), static_cast<std::size_t>(size));
        silent_ = (size <= 0 && !waits(size)) || read_.size() > longest_line;
    }
}

std::string Child::end(double patience) {
    if (process_ <= 0) return {};
    int status = 0;
    const bool by_itself = process_ended_within(patience, process_, status);
    end_group(process_, SIGKILL);
    if (!by_itself) waitpid(process_, &status, 0);
    process_ = 0;
    if (!by_itself) return "closed its output";
    return WIFEXITED(status) ? "ended with exit code " + std::to_string(WEXITSTATUS(status))
                             : "was ended by signal " + std::to_string(WTERMSIG(status));
}

Children::Children(const std::string& command, int count, double seconds, std::filesystem::path log)
    : text_(command), command_(split_command(command)), seconds_(seconds), log_file_(std::move(log)),
      log_(open(log_file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666)),
      children_(static_cast<std::size_t>(count)) {
    if (log_ < 0) rough::refuse(log_file_.string(), ": cannot be written; choose another --out");
}

Children::~Children() {
    for (const auto& child : children_)
        if (child) child->close_input();
    children_.clear();
    bound_log();
    close(log_);
    std::error_code none;
    if (std::filesystem::is_empty(log_file_, none)) std::filesystem::remove(log_file_, none);
}

std::vector<Children::Answer> Children::ask(std::span<const Request> requests, const ga::Watch& watch) {
    std::vector<Answer> answers(requests.size());
    std::atomic<std::size_t> next = 0;
    const auto stops = [&] {
        bound_log();
        return has_trouble_ || watch.expired();
    };
    // One child works until the first success tells the number of objectives.
    const bool begins = !first_;
    const auto work = [&](std::unique_ptr<Child>& child) {
        for (std::size_t i; !stops() && !(begins && first_) && (i = next++) < requests.size();)
            if (const auto known = known_.find(requests[i].genes); known != known_.end())
                answers[i] = known->second;
            else if (answers[i] = answer_of(child, requests[i], stops); begins)
                known_[requests[i].genes] = answers[i];
    };
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < (begins ? 1 : std::min(children_.size(), requests.size())); ++i)
        threads.emplace_back(work, std::ref(children_[i]));
    threads.clear(); // waits for them
    for (std::size_t i = 0; i < requests.size(); ++i)
        if (const auto* answer = std::get_if<Evaluation>(&answers[i]))
            record.take({requests[i].genes, *answer}, requests[i].number);
        else if (const auto* why = std::get_if<ga::Reason>(&answers[i]); why && first_failure_.empty())
            first_failure_ = **why;
    return answers;
}

/// The answer of a child, which is started if it does not run. Pending if `stops` returns true or on trouble.
/// A child that did not answer is ended.
Children::Answer Children::answer_of(std::unique_ptr<Child>& child, const Request& wanted,
                                     const std::function<bool()>& stops) {
    constexpr long max_deaths = 100;
    try {
        if (!child) child = std::make_unique<Child>(command_, log_);
    } catch (const rough::InputError& error) {
        give_up(error.what());
        return {};
    }
    const long id = ++sent_;
    const std::string request = "{\"id\":" + std::to_string(id) + ",\"genes\":" + wanted.genes +
                                (wanted.level.empty() ? "" : ",\"level\":\"" + wanted.level + "\"") + "}";
    const std::string sent = "--evaluate: '" + clipped(text_) + "' was sent " + clipped(request) + " and ";
    const std::string answering = "; answer with a line {\"id\":" + std::to_string(id) + ",\"objectives\":[" +
                                  (objectives() == 0 ? "" : std::to_string(objectives()) + " ") + "finite numbers]}";
    Answer answer;
    if (const auto line = child->answer(request, seconds_, stops)) {
        std::string fault;
        answer = read(*line, id, fault);
        if (const auto* success = std::get_if<Evaluation>(&answer); success && !first_) {
            first_ = *success;
            record.minimise.resize(objectives());
        }
        if (fault.empty()) {
            deaths_ = 0;
            return answer;
        }
        give_up(sent + "answered \"" + clipped(*line) + "\" (" + fault + ")" + answering);
    } else if (child->is_silent()) {
        const std::string& part = child->unfinished();
        const std::string end = (part.empty() ? "" : "wrote \"" + clipped(part) + "\" and ") + child->end(0.2);
        if (++deaths_ >= max_deaths)
            give_up(sent + end + ", the last of " + std::to_string(max_deaths) + " such ends in a row" + answering +
                    log_end());
        else
            answer = ga::reason("'" + clipped(text_) + "' " + end);
    } else if (!stops()) {
        answer = ga::reason("'" + clipped(text_) + "' was silent for " + ga::number(seconds_) +
                            " s; give a longer --timeout, or flush its answers");
    }
    child->end();
    child.reset();
    return answer;
}

Children::Answer Children::read(const std::string& line, long id, std::string& fault) const {
    static const std::regex not_finite("-?\\b(NaN|nan|Infinity|Inf|inf)\\b");
    const auto has_null = [](const nlohmann::json& value) {
        return value.is_null() || std::ranges::any_of(value, &nlohmann::json::is_null);
    };
    try {
        const nlohmann::json j = rough::parsed_json(std::regex_search(line, not_finite) && !nlohmann::json::accept(line)
                                                        ? std::regex_replace(line, not_finite, "null")
                                                        : line,
                                                    "line");
        if (!j.is_object() || !j.contains("id") || !(j.contains("objectives") || j.contains("failed"))) {
            fault = "no object with id and objectives";
            return {};
        }
        if (j["id"] != id) {
            fault = "another id";
            return {};
        }
        if (j.contains("failed"))
            return ga::reason(j["failed"].is_string() ? j["failed"].get<std::string>() : j["failed"].dump());
        if (has_null(j["objectives"]) || (j.contains("violation") && has_null(j["violation"])))
            return ga::reason("an objective or violation is not finite");
        Evaluation answer{j["objectives"].get<std::vector<double>>(), violation_from(j)};
        if (answer.objectives.empty() || answer.objectives.size() > max_objectives ||
            (first_ && answer.objectives.size() != objectives()))
            fault = std::to_string(answer.objectives.size()) + " objectives";
        else if (first_ && answer.violation.size() != first_->violation.size())
            fault = std::to_string(answer.violation.size()) + " violations, " +
                    std::to_string(first_->violation.size()) + " in the first answer";
        else
            return answer;
    } catch (const rough::InputError&) {
        fault = "not JSON";
    } catch (const nlohmann::json::exception&) {
        fault = "not numbers";
    }
    return {};
}

/// Keeps the first message only.
void Children::give_up(const std::string& message) {
    const std::lock_guard lock(trouble_mutex_);
    if (!has_trouble_.exchange(true)) trouble_ = message;
}

std::string Children::log_tail() const {
    struct stat there {};
    fstat(log_, &there);
    std::string tail(static_cast<std::size_t>(std::min(there.st_size, kept_log)), '\0');
    const ssize_t size = pread(log_, tail.data(), tail.size(), std::max<off_t>(0, there.st_size - kept_log));
    tail.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return tail;
}

void Children::bound_log() {
    struct stat there {};
    const std::lock_guard lock(trouble_mutex_);
    if (fstat(log_, &there) != 0 || there.st_size <= max_log) return;
    constexpr off_t blocks = 1 << 20; // some file systems remove the first ones and lose no text
    if (fallocate(log_, FALLOC_FL_COLLAPSE_RANGE, 0, (there.st_size - kept_log) / blocks * blocks) == 0) return;
    std::string tail;
    off_t seen = 0; // text that a child writes between reading and cut is lost
    for (int tries = 0; tries < 100 && fstat(log_, &there) == 0 && there.st_size != seen; ++tries) {
        seen = there.st_size;
        tail = "(the beginning is left out)\n" + log_tail();
    }
    if (ftruncate(log_, 0) == 0) [[maybe_unused]]
        const ssize_t kept = write(log_, tail.data(), tail.size());
}

std::string Children::log_end() {
    bound_log();
    const std::string last = last_line(log_tail());
    return last.empty() ? "" : "; " + log_file_.string() + " ends with \"" + clipped(last) + "\"";
}

} // namespace app
