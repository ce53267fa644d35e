#include "apps/commands/optimise/children.hpp"

#include "domain/errors.hpp"
#include "domain/text/json.hpp"
#include "ga/base/number.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <unistd.h>

namespace app {

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
