#include "domain/numerics/statistics.hpp"
#include "ga/base/random.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rough;

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

TEST_CASE("the slope of a line is exact, and NaN for fewer than two points") {
    CHECK(slope(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(5, 3, 1)) == Approx(-2));
    CHECK(slope(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 3, 0)) == Approx(0).margin(1e-15));
    CHECK(std::isnan(slope(Eigen::VectorXd(1), Eigen::VectorXd(1))));
}

TEST_CASE("linear series correlate fully, and a constant has no correlation") {
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(2, 4, 6)) == Approx(1));
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(3, 2, 1)) == Approx(-1));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7, 7))));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7 + 1e-15, 7))));
    CHECK(std::isnan(pearson(1e6 * Eigen::Array3d(1, 2, 3), Eigen::Array3d(7e6, 7e6 + 1e-9, 7e6))));
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
    for (int i = 1; i <= 15; ++i)
        values.push_back(i);
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
        for (int i = 0; i < 40; ++i)
            values.push_back(stream.normal() + 2);
        const auto of_picks = [&](const std::vector<std::size_t>& picks) {
            double sum = 0;
            for (const std::size_t pick : picks)
                sum += values[pick];
            return sum / static_cast<double>(picks.size());
        };
        const Interval interval = bootstrap_interval(values.size(), of_picks, 200, 0.9, trial);
        held += interval.lower <= 2 && 2 <= interval.upper;
    }
    CHECK(held > 0.84 * trials);
    CHECK(held < 0.94 * trials);
}
