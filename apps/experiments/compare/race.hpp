#pragma once

#include "apps/external/solution.hpp"
#include "ga/base/random.hpp"
#include "ga/problem/permutation.hpp"
#include "ga/problem/problem.hpp"
#include "ga/problem/ranking.hpp"

#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace app {

/// One instance of a benchmark problem, with what it takes to verify a search on it.
template <class G>
struct Instance {
    std::function<Answer(const G&)> evaluate; ///< less is better in every objective
    std::size_t genes = 0;
    std::vector<ga::Variable> box = {}; ///< of real genes
    std::size_t objectives = 1;
    /// Of one objective: precision is (f - best) / scale.
    double best = 0, scale = 1;
    /// Of several: precision is IGD+ from these points of the true front.
    std::shared_ptr<const std::vector<ga::Point>> front = {};
};

using RealInstance = Instance<std::vector<double>>;
using BitsInstance = Instance<std::vector<bool>>;
using TourInstance = Instance<ga::Permutation>;

/// How near the evaluations so far have come: of one objective the least precision of those that hold their
/// constraints; of several IGD+ (Ishibuchi et al. 2015) of all of them together, the mean over the true
/// front's points of how far the nearest evaluation falls short of each.
class Nearness {
  public:
    template <class G>
    explicit Nearness(const Instance<G>& instance)
        : best_(instance.best), scale_(instance.scale), front_(instance.front),
          short_of_(front_ ? front_->size() : 0, HUGE_VAL) {}

    /// With one evaluation more.
    double after(const Answer& value);

  private:
    double best_, scale_;
    std::shared_ptr<const std::vector<ga::Point>> front_;
    std::vector<double> short_of_; ///< squared
    double nearest_ = HUGE_VAL;
};

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
/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reached, evaluations, precision, spent, found)
/// @endcond

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

/// What libpagmo can be compared by, where rugosa was built with it: pagmo:cmaes, pagmo:cmaes-bounded,
/// pagmo:de, pagmo:sade and pagmo:sga.
const std::vector<std::string>& pagmo_variants();

/// Whether a variant's text names one of libpagmo's.
bool is_pagmos(const std::string& variant);

/// Throws ga::UsageError on a name that is none of pagmo_variants, or a problem of several objectives.
void expect_pagmos(const RealInstance& instance, const std::string& variant);

/// The same as raced, by libpagmo's algorithm with its own defaults; it ends by tolerances of 1e-12, and then
/// begins anew. Its population: 4 + 3 ln n of cmaes (Hansen), 5 at least; otherwise 20, of sga 40.
Reached raced_by_pagmo(const RealInstance& instance, const std::string& variant,
                       const std::vector<double>& targets, const Attempt& attempt);

} // namespace app
