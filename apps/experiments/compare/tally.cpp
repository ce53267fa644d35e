#include "apps/experiments/compare/race.hpp"

#include <algorithm>
#include <cmath>

namespace app {

Tally::Tally(const std::vector<double>& targets, const Attempt& attempt)
    : targets_(targets), stop_(attempt.stop) {
    reached_.evaluations.assign(targets.size(), NAN);
}

void Tally::note(long evaluations, double precision) {
    reached_.spent = evaluations;
    reached_.precision = std::min(reached_.precision, precision);
    if (reached_.found.empty() || (next_ < targets_.size() && reached_.precision <= targets_[next_]))
        reached_.found.emplace_back(evaluations, reached_.precision);
    while (next_ < targets_.size() && reached_.precision <= targets_[next_])
        reached_.evaluations[next_++] = static_cast<double>(evaluations);
    if (next_ == targets_.size() || (stop_ && stop_->load(std::memory_order_relaxed)))
        over_ = true;
}

} // namespace app
