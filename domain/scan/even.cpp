#include "domain/scan/even.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Whether the points are multiples of a spacing to the last bit, as those of a column of heights are: then
/// it is the spacing that was given, which a fit finds but for rounding.
bool are_multiples(const std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] != static_cast<double>(i) * x[1])
            return false;
    return x[1] > 0;
}

} // namespace

Evenness evenness(const std::vector<double>& x, const std::vector<double>& last_digit) {
    if (are_multiples(x))
        return {0, x[1], 0, true};
    const double n = static_cast<double>(x.size());
    const double middle = (n - 1) / 2;
    double mean = 0, slope = 0;
    for (const double value : x)
        mean += value / n;
    for (std::size_t i = 0; i < x.size(); ++i)
        slope += (static_cast<double>(i) - middle) * (x[i] - mean);
    slope /= n * (n * n - 1) / 12;

    Evenness fit{mean - slope * middle, slope, 0, slope > 0};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double off = std::abs(x[i] - (fit.first + slope * static_cast<double>(i)));
        fit.deviation = std::max(fit.deviation, off);
        // Rounding moves a point by half its last digit; the fit itself is moved by less than half as much
        // again.
        fit.even = fit.even && off <= std::max(0.75 * last_digit[i], 1e-3 * slope);
    }
    return fit;
}

Profile resampled(const std::vector<double>& x, const std::vector<double>& heights, Index nodes) {
    Profile profile{Eigen::VectorXd(nodes), (x.back() - x.front()) / static_cast<double>(nodes - 1)};
    std::size_t right = 1;
    for (Index i = 0; i < nodes; ++i) {
        const double at = std::min(x.front() + static_cast<double>(i) * profile.spacing, x.back());
        while (right + 1 < x.size() && x[right] < at)
            ++right;
        const double share = (at - x[right - 1]) / (x[right] - x[right - 1]);
        profile.heights[i] = heights[right - 1] + share * (heights[right] - heights[right - 1]);
    }
    return profile;
}

} // namespace rough
