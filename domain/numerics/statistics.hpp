#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace rough {

/// Pearson's correlation of two series of equal length; NaN where one of them does not vary.
double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b);

/// The value below which a share of the values lies, 0 to 1, linear between neighbours in order; values that
/// are NaN are left out, NaN of none.
double quantile(std::vector<double> values, double share);
/// The quantile of one half.
double median(std::vector<double> values);
/// Arithmetic mean; values that are NaN are left out, NaN of none.
double mean(const std::vector<double>& values);

/// Share of the values that are at most `limit`, 0 to 1, where the empirical distribution steps; a NaN is
/// never reached but counts among them. NaN of none.
double share_up_to(const std::vector<double>& values, double limit);

/// From where to where a quantity lies, and how sure that is.
struct Interval {
    double lower;    ///< in the quantity's unit
    double upper;    ///< no less than `lower`
    double coverage; ///< chance that such an interval holds the quantity
};

/// The narrowest pair of order statistics, as far from one end as from the other, that holds the median of
/// any continuous distribution with at least this confidence; of too few values the two extremes, with the
/// coverage they have. NaN counts as greater than all. No value may be missing altogether.
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

/// A member of each row, or what a function says of it.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value value) {
    std::vector<double> values;
    for (const Row& row : rows)
        values.push_back(std::invoke(value, row));
    return values;
}

} // namespace rough
