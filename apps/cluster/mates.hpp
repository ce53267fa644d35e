#pragma once

#include "apps/cluster/hands.hpp"
#include "apps/cluster/talk.hpp"

namespace app::crew {

/// Another rank, as rank 0 knows it.
struct Mate {
    std::string place = "a host that is not known"; ///< where it runs
    std::string introduction;
    int threads = 1; ///< that it has
    bool introduced = false, present = true, left = false;
    std::shared_ptr<const Assignment> told = {}; ///< the last setting sent
    std::deque<std::uint64_t> has = {};          ///< chunks that it was given
    Silence silence = {};
};

/// The other ranks, as rank 0 talks with them. A rank that does not answer is lost: a line on stderr says so,
/// and the program goes on as if it were asked to stop.
class Mates {
  public:
    /// Takes a rank's message of answers.
    using Take = std::function<void(int rank, const std::string& answers)>;

    explicit Mates(int ranks) : all_(static_cast<std::size_t>(ranks - 1)) {}

    /// Throws rough::InputError where one has not begun, or introduces itself otherwise.
    void meet(const std::string& introduction);
    /// Takes in what was said; whether anything was.
    bool listen(const Take& take);
    /// Asks everybody whether they are there: a launcher asks a run to end also when one of its ranks has
    /// died.
    void call_roll(const Take& take);
    /// Of those that have work.
    void expect_signs_of_life();
    /// Whether all have said that they are done; then they leave MPI. Where one is lost nobody does: Open
    /// MPI's mpirun hangs now and then where a run is ended while a rank is in MPI_Finalize.
    bool dismiss();
    bool lost() const { return lost_; } ///< whether a rank is

    std::size_t count() const { return all_.size(); }
    /// Calls one(rank, mate) for each.
    template <class Do>
    void for_each(Do one) {
        for (std::size_t i = 0; i < all_.size(); ++i)
            one(static_cast<int>(i) + 1, all_[i]);
    }

  private:
    void wait_for(double seconds, bool Mate::*is, const Take& take);
    void lose(int rank, const Mate& mate, const std::string& why);

    std::vector<Mate> all_; ///< rank 1 and on
    bool lost_ = false;
    std::jthread watch_;
    std::jthread beat_; ///< tells the others that rank 0 is there, whatever else it is at
};

} // namespace app::crew
