#pragma once

#include "apps/external/solution.hpp"
#include "ga/base/random.hpp"
#include "ga/problem/permutation.hpp"
#include "ga/problem/problem.hpp"
#include "ga/problem/ranking.hpp"

#include <functional>
#include <memory>
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

} // namespace app
