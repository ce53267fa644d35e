#pragma once

#include "apps/experiments/compare/problems/instance.hpp"

#include <atomic>
#include <string>

namespace app {

/// A run's seed, and when it ends.
struct Attempt {
    std::uint64_t seed = 1;
    long budget = 0;                         ///< evaluations
    const std::atomic<bool>* stop = nullptr; ///< somebody asks it to end
};

/// How far one run came.
struct Reached {
    std::vector<double> evaluations; ///< that each target took; NaN where it was missed
    double precision = HUGE_VAL;     ///< the best
    long spent = 0;                  ///< evaluations
    /// Evaluations and the best precision after them: the first, and whenever a target was reached.
    std::vector<std::pair<long, double>> found = {};
};

/// Keeps when a run reaches its targets, and tells it when to end.
class Tally {
  public:
    /// @param targets  precisions, each less than the one before; all reached is the end
    Tally(const std::vector<double>& targets, const Attempt& attempt);

    /// The best precision once so many evaluations are made.
    void note(long evaluations, double precision);
    /// Becomes true when there is nothing more to find, or somebody asks to end.
    const std::atomic<bool>& over() const { return over_; }
    const Reached& reached() const { return reached_; }

  private:
    const std::vector<double>& targets_;
    const std::atomic<bool>* stop_;
    std::size_t next_ = 0;
    std::atomic<bool> over_ = false;
    Reached reached_;
};

/// Runs a pipeline on an instance until its targets are reached or its budget is spent; where it ends before,
/// it begins anew, as COCO has it. In its text `1/n` is one gene's share, `18n` 18 times the genes, and
/// `objectives` stands for the names of all.
template <class G>
Reached raced(const Instance<G>& instance, const std::string& pipeline, const std::vector<double>& targets,
              const Attempt& attempt);

/// Throws ga::UsageError on a pipeline that cannot be run on such an instance.
template <class G>
void expect_fits(const Instance<G>& instance, const std::string& pipeline);

} // namespace app
