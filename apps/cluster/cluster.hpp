#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>

/// One run on several ranks. Rank 0 is the program: it reads, decides, keeps the time and writes. The others
/// are workers: they answer the tasks that it sends and know nothing else of the run.
namespace app::cluster {

using nlohmann::json;

/// Answers one task. Pure; called from several threads at once.
using Work = std::function<json(const json& task)>;

/// The kinds of tasks that every rank can answer: Work from what the tasks of a job have in common.
using Kinds = std::map<std::string, Work (*)(const json& setting)>;

/// Tasks of one kind for all ranks.
struct Job {
    std::string kind;
    json setting;
    int threads = 0;       ///< of each rank; 0: all that it has
    std::size_t count = 0; ///< upper bound of the number of tasks
    /// Task i, for i = 0, 1, ...; none after the last.
    std::function<std::optional<json>(std::size_t i)> task;
    /// Gets the answer to task i, in any order. `task` and `take` are never called at the same time, but from
    /// two threads.
    std::function<void(std::size_t i, const json& answer)> take;
    std::function<bool()> stopped = [] { return false; }; ///< whether no more tasks shall begin
};

/// Joins the other ranks, before all else. A worker answers tasks until rank 0 leaves, then gets true. Rank 0
/// gets false; it throws rough::InputError if the ranks are different builds.
bool join(Kinds kinds);
/// Ends the work of all ranks, after all else. An exit code other than 0 of a worker aborts the whole job.
void leave(int code);

bool is_alone(); ///< Whether there is only one rank.
/// Shares the tasks among all ranks, this one included. Returns when all tasks that have begun are answered.
/// Throws what a task, `task` or `take` threw on rank 0.
void hand_out(const Job& job);

} // namespace app::cluster
