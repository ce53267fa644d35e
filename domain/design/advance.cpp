#include "domain/design/advance.hpp"

#include "domain/response/interface.hpp"

#include <algorithm>

namespace rough {

namespace {

/// A rising piecewise linear y(x), x >= 0, that can be read backwards.
class Rising {
  public:
    Rising(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
        const Index n = x.size();
        const double first_slope = n > 1 ? std::max(0.0, (y[1] - y[0]) / (x[1] - x[0])) : 0.5 * y[0] / x[0];
        points_.emplace_back(0.0, std::max(0.0, y[0] - first_slope * x[0]));
        for (Index k = 0; k < n; ++k)
            points_.emplace_back(x[k], std::max(points_.back().second, y[k]));
        const auto& [x_last, y_last] = points_.back();
        const auto& [x_before, y_before] = points_[points_.size() - 2];
        const double slope = std::max((y_last - y_before) / (x_last - x_before), 0.05 * y_last / x_last);
        points_.emplace_back(x_last * 1000, y_last + slope * x_last * 999);
    }
    /// The first x at which y reaches the value.
    double reaches(double value) const {
        if (value <= points_.front().second)
            return 0;
        const auto above = std::find_if(points_.begin(), points_.end(),
                                        [&](const auto& point) { return point.second >= value; });
        if (above == points_.end())
            return points_.back().first;
        const auto below = above - 1;
        return below->first +
               (above->first - below->first) * (value - below->second) / (above->second - below->second);
    }

  private:
    std::vector<std::pair<double, double>> points_;
};

/// K(P) of a load curve: secants from (0, 0) on, at their mean pressures.
Rising stiffness_of(const Target& target) {
    Eigen::VectorXd P(target.points()), K(target.points());
    double x = 0, y = 0;
    for (Index k = 0; k < target.points(); ++k) {
        P[k] = 0.5 * (target.y[k] + y);
        K[k] = std::max(0.0, target.y[k] - y) / (target.x[k] - x);
        x = target.x[k], y = target.y[k];
    }
    return {P, K};
}

} // namespace

Advance advance_for(const Target& target, Index nodes) {
    const bool by_area = is_contact_fraction(target.quantity);
    const Rising curve =
        target.quantity == Quantity::load_at_displacement ? stiffness_of(target) : Rising(target.x, target.y);
    return [=, quantity = target.quantity](const Eigen::VectorXd& stiffness) {
        const auto most = static_cast<std::size_t>(stiffness.size());
        // Where (pressure, or displacement) the first k + 1 nodes begin to be the contact set.
        std::vector<double> begins(most + 1, 0.0);
        Eigen::VectorXd asked = stiffness; // a periodic body's never has every node, and K_i = K
        if (quantity == Quantity::interface_stiffness && stiffness.size() == nodes)
            for (double& K : asked)
                K = interface_of(K, stiffness[nodes - 1]);
        for (std::size_t k = 1; k < most; ++k)
            begins[k] = std::max(
                begins[k - 1],
                curve.reaches(by_area
                                  ? (static_cast<double>(k) + 0.5) / static_cast<double>(nodes)
                                  : 0.5 * (asked[static_cast<Index>(k) - 1] + asked[static_cast<Index>(k)])));
        begins[most] = begins[most - 1];
        std::vector<double> steps(most);
        for (std::size_t k = 0; k < most; ++k) {
            steps[k] = begins[k + 1] - begins[k];
            if (quantity != Quantity::area_at_displacement) // a pressure
                steps[k] /= stiffness[static_cast<Index>(k)];
        }
        return steps;
    };
}

} // namespace rough
