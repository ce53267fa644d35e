#pragma once

#include "apps/cluster/crew.hpp"
#include "apps/cluster/mates.hpp"

#include <map>

namespace app::crew {

/// Rank 0 as it shares out tasks, for as long as the program runs.
class Foreman {
  public:
    explicit Foreman(int ranks) : mates_(ranks), shares_(static_cast<std::size_t>(ranks)) {}

    void meet(const std::string& introduction) { mates_.meet(introduction); }
    bool is_worth(const std::string& kind, std::size_t tasks, int threads) const;
    void hand_out(const Errand& errand);
    int leave(int code);

  private:
    /// A chunk under way.
    struct Given {
        std::size_t first = 0, count = 0; ///< tasks
        int threads = 1;
    };
    /// What a rank has done.
    struct Share {
        std::size_t tasks = 0;
        double seconds = 0; ///< at them
    };

    void fill(const Errand& errand);
    Chunk cut(const Errand& errand, int threads);
    std::size_t depth(const std::string& kind) const;
    bool take_own(const Errand& errand);
    void take(const Errand& errand, const Done& done, int rank);
    void call_off();

    Mates mates_;
    Hands hands_;
    std::vector<Share> shares_;                  ///< rank 0 and on
    std::shared_ptr<const Assignment> of_;       ///< what is handed out now
    std::map<std::string, double> seconds_each_; ///< of one thread for a task, by kind: what was measured
    std::map<std::uint64_t, Given> open_;        ///< chunks of the errand that are not answered
    std::uint64_t chunks_ = 0;
    std::size_t next_ = 0; ///< the next task's place
    bool over_ = false;    ///< there are no more
    double talking_ = 0;   ///< processor time of this rank's main thread with errands, s
};

} // namespace app::crew
