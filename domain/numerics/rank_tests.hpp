#pragma once

#include <vector>

namespace rough {

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
    double p = 1; ///< p-value from the chi-square distribution with one degree less than treatments
};
/// @param blocks  at least one row, each with one value per treatment
Friedman friedman(const std::vector<std::vector<double>>& blocks);

/// p-values of a family of tests after Holm's correction (1979), in the given order. Rejecting those up to a
/// level keeps the probability of any false rejection below it.
std::vector<double> holm(const std::vector<double>& p);

} // namespace rough
