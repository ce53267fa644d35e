#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace ga {

/// Whom a stage keeps of a scored population: those above a fitness, and the best in any case.
struct Demand {
    static constexpr std::size_t as_many_as_start = static_cast<std::size_t>(-1); ///< for `best`

    std::size_t best = 0;    ///< so many of the best
    double above = HUGE_VAL; ///< and everybody whose fitness is above this
    bool with_start = false; ///< the generation's start competes for the best places, too
};

/// The fitness below which nobody is kept, as far as is known: that of the last of the best so far, or the
/// threshold where that is lower.
class Floor {
  public:
    /// What is to be kept.
    explicit Floor(const Demand& demand) : demand_(demand) {}

    /// Takes note of somebody's fitness.
    void offer(double fitness) {
        best_.insert(std::upper_bound(best_.begin(), best_.end(), fitness, std::greater<>()), fitness);
        best_.resize(std::min(best_.size(), demand_.best));
    }
    /// Whether one of this fitness would be kept, besides so many others who are better.
    bool would_keep(double fitness, std::size_t better) const {
        const auto known = std::lower_bound(best_.begin(), best_.end(), fitness, std::greater<>());
        return fitness >= demand_.above ||
               better + static_cast<std::size_t>(known - best_.begin()) < demand_.best;
    }
    /// Nobody below it is kept.
    double value() const {
        return best_.size() < demand_.best ? -HUGE_VAL
               : best_.empty()             ? demand_.above
                                           : std::min(demand_.above, best_.back());
    }

  private:
    Demand demand_;
    std::vector<double> best_; ///< descending
};

} // namespace ga
