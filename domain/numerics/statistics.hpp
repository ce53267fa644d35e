#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace rough {

/// Pearson's correlation of two series of equal length; NaN if one of them does not vary.
double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b);

/// The value below which a share of the values lies, 0 to 1, linear between neighbours in order. NaN values
/// are left out; NaN without values.
double quantile(std::vector<double> values, double share);
/// The quantile of one half.
double median(std::vector<double> values);
/// Arithmetic mean; NaN values are left out, NaN without values.
double mean(const std::vector<double>& values);

/// Share of the values that are at most `limit`, 0 to 1; the empirical distribution steps at each value. NaN
/// counts as above every limit. NaN without values.
double share_up_to(const std::vector<double>& values, double limit);

/// An interval for a quantity, and its coverage.
struct Interval {
    double lower;    ///< in the quantity's unit
    double upper;    ///< no less than `lower`
    double coverage; ///< probability that such an interval holds the quantity
};

/// The narrowest pair of order statistics, equally far from both ends, that holds the median of any
/// continuous distribution with at least this confidence. With too few values, the two extremes with their
/// coverage. NaN counts as greater than all. `values` must not be empty.
Interval median_interval(std::vector<double> values, double confidence = 0.95);

/// Efron's percentile interval (1979) of a statistic of n observations.
/// @param statistic  of the observations with these indices, which may repeat
/// @param draws      resamples
/// @param seed       of the resamples
Interval bootstrap_interval(std::size_t n,
                            const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            std::size_t draws, double confidence, std::uint64_t seed);

/// Slope of the least-squares line through the points (x, y); NaN for fewer than two.
double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// A member of each row, or a function's value for it.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value value) {
    std::vector<double> values;
    for (const Row& row : rows)
        values.push_back(std::invoke(value, row));
    return values;
}

} // namespace rough
