#pragma once

#include "ga/base/json.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>

/// One run on several ranks. Rank 0 is the program: it reads, decides, keeps the time and writes. The other
/// ranks are workers, which only answer the tasks that it sends.
namespace app::cluster {

using nlohmann::json;

/// Answers one task. Pure; called from several threads at once.
using Work = std::function<json(const json& task)>;

/// The kinds of tasks that every rank can answer. Each makes Work from the data that the tasks share.
using Kinds = std::map<std::string, Work (*)(const json& setting)>;

/// Tasks of one kind for all ranks.
struct Job {
    std::string kind;
    json setting;
    int threads = 0;       ///< threads of each rank; 0: all
    std::size_t count = 0; ///< upper bound of the number of tasks
    /// Task i, for i = 0, 1, ...; none after the last.
    std::function<std::optional<json>(std::size_t i)> task;
    /// Gets the answer to task i, in any order.
    std::function<void(std::size_t i, const json& answer)> take;
    std::function<bool()> stopped = [] { return false; }; ///< whether no further task may begin
};

/// Joins the other ranks; must be called first. On a worker it answers tasks until rank 0 leaves, then
/// returns true. On rank 0 it returns false, and throws rough::InputError if the ranks are different builds.
bool join(Kinds kinds);
/// Ends the work of all ranks; must be called last. A worker's exit code other than 0 aborts the whole job.
void leave(int code);

bool is_alone(); ///< Whether there is only one rank.
/// Throws rough::InputError unless a message has the form that this program sends.
void expect_message(bool good);
/// Shares the tasks among all ranks, including this one. Returns when all tasks that have begun are answered.
/// Rethrows the exceptions of tasks, `task` and `take` on rank 0.
void hand_out(const Job& job);

} // namespace app::cluster
