#include "ga/adaptation/differential_evolution.hpp"

#include <catch2/catch.hpp>

using namespace ga;

using Vector = std::vector<double>;

TEST_CASE(
    "a trial of differential evolution is the mutant where it crosses, halfway to a bound it would pass") {
    const Vector base{1, 1, 1}, a{2, 3, 1}, b{4, 0, 9}, c{1, 1, 1}, target{7, 8, 0};
    const std::vector<Variable> box{{0, -10, 10}, {1, -10, 10}, {2, -10, 4}};
    Stream stream(1);
    const Vector trial = Difference{base, a, b, c, 0.5, 0.8, 1}.trial(target, box, stream);
    CHECK(trial[0] == Approx(1 + 0.5 * 1 + 0.8 * 3));
    CHECK(trial[1] == Approx(1 + 0.5 * 2 - 0.8));
    CHECK(trial[2] == (0 + 4) / 2.0);
    int changed = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        Stream each(i);
        const Vector one = Difference{base, a, b, c, 0.5, 0.8, 0}.trial(target, box, each);
        int here = 0;
        for (std::size_t g = 0; g < 3; ++g)
            here += one[g] != target[g] ? 1 : 0;
        CHECK(here == 1); // one gene in any case
        changed += one[0] != target[0] ? 1 : 0;
    }
    CHECK(changed > 70);
    CHECK(changed < 130);
}

TEST_CASE("exponential cross-over takes genes in a row, as many as a run of successes and one") {
    const std::size_t n = 5;
    const Vector base(n, 1), zero(n, 0), target(n, 0);
    std::vector<Variable> box;
    for (std::size_t g = 0; g < n; ++g)
        box.push_back({g, -10, 10});
    const double cr = 0.7;
    const int trials = 20000;
    std::vector<int> of_length(n + 1), begun(n);
    for (int i = 0; i < trials; ++i) {
        Stream stream(static_cast<std::uint64_t>(i));
        const Vector trial = Difference{base, base, zero, zero, 0, 0, cr, true}.trial(target, box, stream);
        std::size_t taken = 0, begins = 0, first = 0;
        for (std::size_t g = 0; g < n; ++g) {
            taken += trial[g] == 1 ? 1 : 0;
            if (trial[g] == 1 && trial[(g + n - 1) % n] == 0)
                ++begins, first = g;
        }
        REQUIRE(begins == (taken < n ? 1 : 0)); // in a row, over the end into the beginning
        ++of_length[taken];
        if (taken < n)
            ++begun[first];
    }
    for (std::size_t length = 1; length <= n; ++length) { // P(L >= l) = CR^(l - 1), within four deviations
        const double p = std::pow(cr, static_cast<double>(length - 1)) * (length < n ? 1 - cr : 1);
        CHECK(std::abs(of_length[length] - trials * p) < 4 * std::sqrt(trials * p * (1 - p)));
    }
    const double p = (1 - std::pow(cr, n - 1.0)) / n;
    for (const int count : begun)
        CHECK(std::abs(count - trials * p) < 4 * std::sqrt(trials * p * (1 - p)));
    CHECK_THROWS_WITH(differential_evolution("rand", 0.5, 0.9, "Exp"),
                      "stage 'de': crossing is 'Exp'; expected bin or exp");
}
