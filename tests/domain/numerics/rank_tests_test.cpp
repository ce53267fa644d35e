#include "domain/numerics/statistics.hpp"
#include "ga/base/random.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using Values = std::vector<double>;

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
    CHECK(rank_sum_p({0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46},
                     {1.15, 0.88, 0.90, 0.74, 1.21}) == Approx(2 * 0.1272).epsilon(1e-3));
    CHECK(rank_sum_p({1, 1, 1}, {1, 1}) == 1);
    CHECK(rank_sum_p({}, {1, 2}) == 1);
}

TEST_CASE("ties keep their ranks in an exact count") {
    // 2 of the ranks 1, 2.5, 2.5, 4 have 6 sums; none is under 3.5, and two are 3.5.
    CHECK(rank_sum_p({1, 2}, {2, 3}) == Approx(2 * 2 / 6.0));
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
    for (int i = 0; i < 401; ++i)
        differences.push_back(stream.normal() + 0.1);
    const double approximated = signed_rank_p(differences);
    differences.pop_back();
    CHECK(signed_rank_p(differences) == Approx(approximated).margin(0.02));
}

TEST_CASE("the signed-rank test has the p-values of the published tables") {
    // Hollander and Wolfe (1973), p. 29: V = 40 of 9 pairs, one-sided 0.01953.
    CHECK(signed_rank_p({1.83 - 0.878, 0.50 - 0.647, 1.62 - 0.598, 2.48 - 2.05, 1.68 - 1.06, 1.88 - 1.29,
                         1.55 - 1.06, 3.06 - 3.14, 1.30 - 1.29}) == Approx(2 * 0.01953125));
    CHECK(signed_rank_p({1, 2, 3, 4, 5}) == Approx(2 / 32.0));
    // n = 10, T = 8: 25 of 1024 signs (Wilcoxon's table: the largest T at 0.05).
    CHECK(signed_rank_p({-8, 1, 2, 3, 4, 5, 6, 7, 9, 10}) == Approx(2 * 25 / 1024.0));
    CHECK(signed_rank_p({0, 0, 3, -1}) == Approx(signed_rank_p({3, -1})));
    CHECK(signed_rank_p({0, 0}) == 1);
}

TEST_CASE("Friedman's test gives the published result of 22 players") {
    // Hollander and Wolfe (1973), p. 140: 22 players, three methods of rounding first base.
    const Friedman found = friedman(
        {{5.40, 5.50, 5.55}, {5.85, 5.70, 5.75}, {5.20, 5.60, 5.50}, {5.55, 5.50, 5.40}, {5.90, 5.85, 5.70},
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
