#pragma once

#include "apps/cluster/kinds.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace app {

/// What tasks have in common.
struct Assignment {
    std::string kind; ///< of kinds()
    std::string setting;
};

/// Tasks that are done together.
struct Chunk {
    std::uint64_t id = 0; ///< larger than of all before
    int threads = 0;      ///< 0: all that there are
    std::shared_ptr<const Assignment> of = {};
    std::vector<std::string> tasks = {};
};

/// What became of a chunk.
struct Done {
    std::uint64_t id = 0;
    double seconds = 0;
    std::vector<std::string> answers = {}; ///< in the tasks' order
    std::string error = {};                ///< what was thrown; there are no answers then
};

/// A rank's own workers: one chunk after the other, each on many threads, while its main thread talks.
class Hands {
  public:
    Hands() = default;
    Hands(const Hands&) = delete;
    ~Hands();

    void give(Chunk chunk);
    std::optional<Done> done(); ///< does not wait
    std::size_t has() const;    ///< chunks given whose answers were not taken
    /// Leaves out what is not begun of the chunks given so far; they are done soon, without answers.
    void drop();
    /// Until something is done, or so long.
    void wait(std::chrono::microseconds most);

  private:
    void work();

    mutable std::mutex guard_;
    std::condition_variable given_, done_;
    std::deque<Chunk> chunks_;
    std::deque<Done> finished_;
    std::size_t has_ = 0;
    std::uint64_t last_ = 0;
    std::atomic<std::uint64_t> dropped_ = 0; ///< the last chunk that is not wanted
    bool ends_ = false;
    std::thread thread_;
};

} // namespace app
