#include "domain/numerics/statistics.hpp"
#include "ga/base/random.hpp"
#include "tests/catch.hpp"

using namespace rough;
using Values = std::vector<double>;

TEST_CASE("quantiles interpolate between ordered values and ignore NaN") {
    const double nan = std::nan("");
    CHECK(quantile({4, 1, nan, 2, 3}, 0) == 1);
    CHECK(quantile({4, 1, nan, 2, 3}, 1) == 4);
    CHECK(quantile({4, 1, nan, 2, 3}, 0.1) == Approx(1.3));
    CHECK(median({4, 1, 2, 3}) == Approx(2.5));
    CHECK(median({3, nan, 1}) == 2);
    CHECK(mean({1, nan, 2, 6}) == 3);
    CHECK(std::isnan(median({})));
    CHECK(std::isnan(mean({nan})));
}

TEST_CASE("linear series correlate fully, and a constant has no correlation") {
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(2, 4, 6)) == Approx(1));
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(3, 2, 1)) == Approx(-1));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7, 7))));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7 + 1e-15, 7))));
    for (const double size : {1e-12, 1e12}) // whatever their units
        CHECK(pearson(size * Eigen::Array3d(1, 2, 3), Eigen::Array3d(2, 4, 6) / size) == Approx(1));
}

TEST_CASE("the empirical distribution steps at each value and counts NaN") {
    const std::vector<double> values{3, 1, std::nan(""), 2};
    CHECK(share_up_to(values, 0.9) == 0);
    CHECK(share_up_to(values, 1) == 0.25);
    CHECK(share_up_to(values, 2.5) == 0.5);
    CHECK(share_up_to(values, 1e9) == 0.75);
    CHECK(std::isnan(share_up_to({}, 1)));
}

TEST_CASE("the interval of a median is that of the binomial table") {
    std::vector<double> values;
    for (int i = 1; i <= 15; ++i) values.push_back(i);
    const Interval of15 = median_interval(values); // the 4th and 12th of 15: 96.48 %
    CHECK(of15.lower == 4);
    CHECK(of15.upper == 12);
    CHECK(of15.coverage == Approx(0.96484).epsilon(1e-4));
    const Interval of3 = median_interval({2, 9, 4}); // too few: the extremes with their coverage
    CHECK(of3.lower == 2);
    CHECK(of3.upper == 9);
    CHECK(of3.coverage == Approx(0.75));
    CHECK(median_interval({7}).lower == 7);
    CHECK(median_interval({7}).coverage == Approx(0).margin(1e-15));
    CHECK(std::isnan(median_interval({1, 2, std::nan("")}).upper));
}

TEST_CASE("a bootstrap interval holds the mean about as often as its confidence") {
    int held = 0;
    constexpr int trials = 400;
    for (std::uint64_t trial = 0; trial < trials; ++trial) {
        ga::Stream stream(ga::fold(3, trial));
        std::vector<double> values;
        for (int i = 0; i < 40; ++i) values.push_back(stream.normal() + 2);
        const auto of_picks = [&](const std::vector<std::size_t>& picks) {
            double sum = 0;
            for (const std::size_t pick : picks) sum += values[pick];
            return sum / static_cast<double>(picks.size());
        };
        const Interval interval = bootstrap_interval(values.size(), of_picks, 200, 0.9, trial);
        held += interval.lower <= 2 && 2 <= interval.upper;
    }
    CHECK(held > 0.84 * trials);
    CHECK(held < 0.94 * trials);
    const auto first = [](const std::vector<std::size_t>& picks) { return static_cast<double>(picks[0]); };
    const Interval of_one_draw = bootstrap_interval(9, first, 1, 0.9, 1);
    CHECK(of_one_draw.lower == of_one_draw.upper);
}

TEST_CASE("equal values share the mean of their ranks") {
    CHECK(ranks({30, 10, 20}) == Values{3, 1, 2});
    CHECK(ranks({5, 1, 5, 5}) == Values{3, 1, 3, 3});
    CHECK(ranks({2, 2}) == Values{1.5, 1.5});
    CHECK(ranks({}).empty());
}

TEST_CASE("the rank-sum test has the p-values of the published tables") {
    // U = 2 of 5 and 5: 4 of 252 choices lie as far to this side (Mann and Whitney 1947, Table I).
    CHECK(rank_sum_p({1, 2, 3, 4, 7}, {5, 6, 8, 9, 10}) == Approx(2 * 4 / 252.0));
    CHECK(rank_sum_p({1, 2, 3}, {4, 5, 6}) == Approx(2 / 20.0));
    // Hollander and Wolfe (1973), p. 69: one-sided 0.1272.
    CHECK(rank_sum_p({0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46}, {1.15, 0.88, 0.90, 0.74, 1.21}) ==
          Approx(2 * 0.1272).epsilon(1e-3));
    // Ties keep their ranks: 2 of 1, 2.5, 2.5, 4 have 6 sums; none is under 3.5, and two are 3.5.
    CHECK(rank_sum_p({1, 2}, {2, 3}) == Approx(2 * 2 / 6.0));
    CHECK(rank_sum_p({1, 1, 1}, {1, 1}) == 1);
    CHECK(rank_sum_p({}, {1, 2}) == 1);
}

TEST_CASE("the normal approximation continues the exact p-values") {
    ga::Stream stream(4);
    Values a, b;
    for (int i = 0; i < 30; ++i) {
        a.push_back(stream.normal());
        b.push_back(stream.normal() + 0.5);
    }
    const double counted = rank_sum_p(a, b);
    b.push_back(0.4); // beyond what is counted
    CHECK(rank_sum_p(a, b) == Approx(counted).margin(0.02));
    Values differences;
    for (int i = 0; i < 401; ++i) differences.push_back(stream.normal() + 0.1);
    const double approximated = signed_rank_p(differences);
    differences.pop_back();
    CHECK(signed_rank_p(differences) == Approx(approximated).margin(0.02));
}

TEST_CASE("the signed-rank test has the p-values of the published tables") {
    // Hollander and Wolfe (1973), p. 29: V = 40 of 9 pairs, one-sided 0.01953.
    CHECK(signed_rank_p({1.83 - 0.878, 0.50 - 0.647, 1.62 - 0.598, 2.48 - 2.05, 1.68 - 1.06, 1.88 - 1.29, 1.55 - 1.06,
                         3.06 - 3.14, 1.30 - 1.29}) == Approx(2 * 0.01953125));
    CHECK(signed_rank_p({1, 2, 3, 4, 5}) == Approx(2 / 32.0));
    // n = 10, T = 8: 25 of 1024 signs (Wilcoxon's table: the largest T at 0.05).
    CHECK(signed_rank_p({-8, 1, 2, 3, 4, 5, 6, 7, 9, 10}) == Approx(2 * 25 / 1024.0));
    CHECK(signed_rank_p({0, 0, 3, -1}) == Approx(signed_rank_p({3, -1})));
    CHECK(signed_rank_p({0, 0}) == 1);
}

TEST_CASE("Friedman's test gives the published result of 22 players") {
    // Hollander and Wolfe (1973), p. 140: 22 players, three methods of rounding first base.
    const Friedman found =
        friedman({{5.40, 5.50, 5.55}, {5.85, 5.70, 5.75}, {5.20, 5.60, 5.50}, {5.55, 5.50, 5.40}, {5.90, 5.85, 5.70},
                  {5.45, 5.55, 5.60}, {5.40, 5.40, 5.35}, {5.45, 5.50, 5.35}, {5.25, 5.15, 5.00}, {5.85, 5.80, 5.70},
                  {5.25, 5.20, 5.10}, {5.65, 5.55, 5.45}, {5.60, 5.35, 5.45}, {5.05, 5.00, 4.95}, {5.50, 5.50, 5.40},
                  {5.45, 5.55, 5.50}, {5.55, 5.55, 5.35}, {5.45, 5.50, 5.55}, {5.50, 5.45, 5.25}, {5.65, 5.60, 5.40},
                  {5.70, 5.65, 5.55}, {6.30, 6.30, 6.25}});
    CHECK(found.statistic == Approx(11.1429).epsilon(1e-4));
    CHECK(found.p == Approx(0.003805).epsilon(1e-3));
    CHECK(found.mean_ranks[2] < found.mean_ranks[1]);
    CHECK(friedman({{1, 1, 1}, {2, 2, 2}}).p == 1);
}

TEST_CASE("Holm's correction gives the p-values of its definition") {
    const Values corrected = holm({0.01, 0.04, 0.03, 0.005});
    CHECK(corrected[3] == Approx(0.02));
    CHECK(corrected[0] == Approx(0.03));
    CHECK(corrected[2] == Approx(0.06));
    CHECK(corrected[1] == Approx(0.06));
    CHECK(holm({0.4, 0.9})[0] == Approx(0.8));
    CHECK(holm({0.7, 0.9}) == Values{1, 1});
}
