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
Interval bootstrap_interval(std::size_t n, const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            std::size_t draws, double confidence, std::uint64_t seed);

/// Slope of the least-squares line through the points (x, y); NaN for fewer than two.
double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Positions in ascending order of the values; ties by position. No value may be NaN.
std::vector<std::size_t> ascending(const std::vector<double>& values);

/// Ranks from 1 for the smallest; equal values share the mean of theirs. No value may be NaN.
std::vector<double> ranks(const std::vector<double>& values);

/// Two-sided p of the rank-sum test (Wilcoxon 1945, Mann and Whitney 1947). It is the probability that two
/// samples of one distribution differ as much as these in the sum of ranks. Exact up to 60 values together,
/// by counting all assignments of the ranks; ties keep their ranks. For more values by the normal
/// approximation with corrections for ties and continuity. 1 if a sample is empty.
double rank_sum_p(const std::vector<double>& first, const std::vector<double>& second);

/// Two-sided p of the signed-rank test (Wilcoxon 1945) of paired differences. It is the probability that
/// differences symmetric about 0 are as asymmetric as these. Differences of 0 are left out. Exact up to 400
/// by counting all signs, for more by the normal approximation. 1 if none is left.
double signed_rank_p(std::vector<double> differences);

/// Friedman's test of several treatments on the same blocks.
struct Friedman {
    std::vector<double> mean_ranks; ///< mean rank of each treatment over the blocks; 1 for the smallest value
    double statistic = 0;           ///< Friedman's chi-square with its correction for ties
    double p = 1;                   ///< p-value from the chi-square distribution with one degree less than treatments
};
/// @param blocks  at least one row, each with one value per treatment
Friedman friedman(const std::vector<std::vector<double>>& blocks);

/// p-values of a family of tests after Holm's correction (1979), in the given order. Rejecting those up to a
/// level keeps the probability of any false rejection below it.
std::vector<double> holm(const std::vector<double>& p);

/// A member of each row, or a function's value for it.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value value) {
    std::vector<double> values;
    for (const Row& row : rows) values.push_back(std::invoke(value, row));
    return values;
}

} // namespace rough
