#include "apps/experiments/compare/problems/instance.hpp"

#include <algorithm>
#include <cmath>

namespace app {

double Nearness::after(const Answer& value) {
    if (violated(value) > 0)
        return nearest_;
    if (!front_)
        return nearest_ = std::min(nearest_, (value.objectives[0] - best_) / scale_);
    bool nearer = false;
    for (std::size_t i = 0; i < short_of_.size(); ++i) {
        const ga::Point& wanted = (*front_)[i];
        double sum = 0;
        for (std::size_t k = 0; k < wanted.size() && sum < short_of_[i]; ++k) {
            const double worse = std::max(0.0, value.objectives[k] - wanted[k]);
            sum += worse * worse;
        }
        if (sum < short_of_[i]) {
            short_of_[i] = sum;
            nearer = true;
        }
    }
    if (nearer) {
        nearest_ = 0;
        for (const double squared : short_of_)
            nearest_ += std::sqrt(squared) / static_cast<double>(short_of_.size());
    }
    return nearest_;
}

} // namespace app
