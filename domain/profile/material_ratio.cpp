#include "domain/profile/material_ratio.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

double material_ratio(const Profile& profile, double level) {
    const Eigen::VectorXd& z = profile.heights;
    if (profile.is_2d())
        return (z.array() > level).cast<double>().mean();
    double sum = 0;
    for (Index i = 1; i < z.size(); ++i) {
        const double low = std::min(z[i], z[i - 1]), high = std::max(z[i], z[i - 1]);
        sum += level <= low ? 1 : level >= high ? 0 : (high - level) / (high - low);
    }
    return sum / static_cast<double>(z.size() - 1);
}

double material_height(const Eigen::VectorXd& heights, double ratio) {
    return quantile({heights.begin(), heights.end()}, 1 - ratio);
}

CoreHeights core_heights(const Eigen::VectorXd& heights) {
    const Index n = heights.size();
    if (n < 5)
        refuse("material ratio curve: ", n, " nodes, expected 5 or more");
    Eigen::VectorXd z = heights; // node i of the curve stands at (i + 1/2)/n
    std::sort(z.begin(), z.end(), std::greater<>());
    const double count = static_cast<double>(n);
    const Index window = std::clamp<Index>(std::lround(0.4 * count), 2, n);
    Index first = 0;
    const double range = z[0] - z[n - 1];
    for (Index i = 1; i + window <= n; ++i)
        if (z[i] - z[i + window - 1] < z[first] - z[first + window - 1] - 1e-12 * range)
            first = i;
    const Eigen::VectorXd core = z.segment(first, window);
    const Eigen::ArrayXd t =
        Eigen::ArrayXd::LinSpaced(window, -1, 1) * (static_cast<double>(window - 1) / 2 / count);
    const double slope = (t * core.array()).sum() / t.square().sum(); // per unit of share, <= 0
    const double middle = (static_cast<double>(first) + static_cast<double>(window) / 2) / count;
    const double upper = core.mean() - slope * middle, lower = upper + slope;

    CoreHeights result;
    result.Rk = upper - lower;
    // Where the curve, straight between its nodes, crosses a level; areas beyond it, to the same accuracy.
    const auto crossing = [&](double level) {
        const Index above = std::lower_bound(z.begin(), z.end(), level, std::greater<>()) - z.begin();
        if (above == 0 || above == n)
            return static_cast<double>(above) / count;
        const double part = (z[above - 1] - level) / (z[above - 1] - z[above]);
        return (static_cast<double>(above) - 0.5 + part) / count;
    };
    result.Mr1 = crossing(upper), result.Mr2 = crossing(lower);
    const double peaks = (z.array() - upper).max(0).sum() / count,
                 valleys = (lower - z.array()).max(0).sum() / count;
    result.Rpk = result.Mr1 > 0 ? 2 * peaks / result.Mr1 : 0;
    result.Rvk = result.Mr2 < 1 ? 2 * valleys / (1 - result.Mr2) : 0;
    return result;
}

} // namespace rough
