#pragma once

#include "apps/external/solution.hpp"
#include "ga/problem/comparison.hpp"
#include "ga/problem/problem.hpp"

#include <atomic>

namespace app {

/// One instance of a benchmark problem, with its optimum or its true front.
template <class G>
struct Instance {
    std::function<Evaluation(const G&)> evaluate; ///< lower is better in every objective
    std::size_t genes = 0;
    std::vector<ga::Variable> box = {}; ///< ranges of real genes
    std::size_t objectives = 1;
    double best = 0, scale = 1; ///< for one objective: precision is (f - best) / scale
    bool constrained = false;   ///< whether evaluations have violations
    /// For several objectives: precision is IGD+ from these points of the true front.
    std::shared_ptr<const std::vector<ga::Point>> front = {};
};

using RealInstance = Instance<std::vector<double>>;
using BitsInstance = Instance<std::vector<bool>>;
using TourInstance = Instance<ga::Permutation>;

/// The precision of all feasible evaluations so far. For one objective it is the lowest precision. For several it is
/// IGD+ (Ishibuchi et al. 2015): the mean over the true front's points of the shortfall of the nearest evaluation.
class Nearness {
  public:
    template <class G>
    explicit Nearness(const Instance<G>& instance)
        : best_(instance.best), scale_(instance.scale), front_(instance.front),
          short_of_(front_ ? front_->size() : 0, HUGE_VAL) {}

    /// The precision after one more evaluation.
    double after(const Evaluation& value);

  private:
    double best_, scale_;
    std::shared_ptr<const std::vector<ga::Point>> front_;
    std::vector<double> short_of_; ///< squared
    double nearest_ = HUGE_VAL;
};

/// The hypervolume of points when the true front's objectives have the range 0 to 1. The reference point is at
/// 1.1 in each. NaN without a front.
template <class G>
double hypervolume(const Instance<G>& instance, std::vector<ga::Point> points);

/// A run's seed and its limits.
struct Attempt {
    std::uint64_t seed = 1;
    long budget = 0;                         ///< maximum number of evaluations
    const std::atomic<bool>* stop = nullptr; ///< true ends the run
};

/// The result of one run.
struct Reached {
    std::vector<double> evaluations; ///< at which each target was reached; NaN if it was missed
    double precision = HUGE_VAL;     ///< best precision
    long spent = 0;                  ///< number of evaluations
    /// Evaluations and the best precision after them: the first, whenever a target was reached, and every
    /// improvement after the last target.
    std::vector<std::pair<long, double>> found = {};
    /// The designed surface of a run on roughness, with the keys of a variant in result.json: its
    /// similarities, its cost and its genome. A map also has `last_displacement_mm`. Null on other problems.
    nlohmann::json surface = {};
    double hypervolume = NAN; ///< see app::hypervolume, of the last population
};
/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reached, evaluations, precision, spent, found, surface, hypervolume)
/// @endcond

/// Records when a run reaches its targets.
class Tally {
  public:
    /// @param targets  falling precisions
    Tally(const std::vector<double>& targets, const Attempt& attempt);

    /// Records the precision after a number of evaluations.
    void note(long evaluations, double precision);
    /// Becomes true after the last target, or when the attempt's stop is true.
    const std::atomic<bool>& ended() const { return ended_; }
    const Reached& reached() const { return reached_; }

  private:
    const std::vector<double>& targets_;
    const std::atomic<bool>* stop_;
    std::size_t next_ = 0;
    std::atomic<bool> ended_ = false;
    Reached reached_;
};

/// Runs a variant on an instance until its targets are reached or its budget is spent. A variant is a pipeline or the
/// name of an algorithm of libpagmo. If it ends earlier it restarts, as in COCO. In a pipeline `1/n` is one gene's
/// share, and `18n` is 18 times the number of genes. `objectives` stands for the names of all objectives.
template <class G>
Reached raced(const Instance<G>& instance, const std::string& variant, const std::vector<double>& targets,
              const Attempt& attempt);

/// Throws ga::UsageError on a variant that cannot be run on such an instance.
template <class G>
void expect_fits(const Instance<G>& instance, const std::string& variant);

/// Algorithms of libpagmo: pagmo:cmaes, pagmo:cmaes-bounded, pagmo:de, pagmo:sade and pagmo:sga, or for
/// several objectives pagmo:nsga2 and pagmo:moead. Empty if rugosa was built without it.
const std::vector<std::string>& pagmo_variants(bool several = false);

/// Throws ga::UsageError on a name that is not in pagmo_variants for these objectives, and on constraints.
void expect_pagmos(const RealInstance& instance, const std::string& variant);

/// Runs an algorithm of libpagmo with its default parameters on an instance. It ends by tolerances of 1e-12 and then
/// restarts. The population is 40 for sga and 20 for de and sade. For cmaes it is 4 + 3 ln n (Hansen), at least 5. For
/// several objectives it is 100, and moead draws its weights from a sequence of low discrepancy.
Reached raced_by_pagmo(const RealInstance& instance, const std::string& variant, const std::vector<double>& targets,
                       const Attempt& attempt);

} // namespace app
