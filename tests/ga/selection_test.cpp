#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace ga;

namespace {

/// How often each individual of fitness 0 .. n-1 is chosen, over many draws, per place.
std::vector<double> chosen(const auto& selection, std::size_t n, int draws) {
    std::vector<double> values(n);
    std::iota(values.begin(), values.end(), 0.0);
    std::vector<double> counts(n);
    for (int seed = 0; seed < draws; ++seed) {
        const auto result =
            run(score() | selection, Given{}, Given::of(values), {.seed = static_cast<std::uint64_t>(seed)});
        REQUIRE(result.population.size() == n);
        for (const auto& each : result.population)
            counts[each.identity] += 1.0 / draws;
    }
    return counts;
}

} // namespace

TEST_CASE("a tournament of k chooses the i-th worst of n with probability ((i+1)/n)^k - (i/n)^k") {
    constexpr std::size_t n = 8;
    for (const std::size_t k : {1u, 2u, 5u}) {
        const auto counts = chosen(tournament(k), n, 4000);
        for (std::size_t i = 0; i < n; ++i) {
            const auto power = [&](std::size_t j) {
                return std::pow(static_cast<double>(j) / n, static_cast<double>(k));
            };
            const double expected = n * (power(i + 1) - power(i));
            // 4000 x 8 draws: five standard deviations of a binomial count
            CHECK(counts[i] == Approx(expected).margin(5 * std::sqrt(std::max(expected, 0.01) / 4000)));
        }
    }
}

TEST_CASE("roulette and universal sampling choose in proportion to the fitness above the worst") {
    constexpr std::size_t n = 6;
    const auto spun = chosen(roulette(), n, 4000), sampled = chosen(sus(), n, 4000);
    for (std::size_t i = 0; i < n; ++i) {
        const double expected = n * static_cast<double>(i) / 15;
        CHECK(spun[i] == Approx(expected).margin(5 * std::sqrt(std::max(expected, 0.01) / 4000)));
        CHECK(sampled[i] == Approx(expected).margin(5 * std::sqrt(0.25 / 4000)));
    }
}

TEST_CASE("universal sampling leaves no individual more than one place from its due") {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto result = run(score() | sus(), Given{}, Given::of({0, 1, 2, 3, 4, 5}), {.seed = seed});
        for (Identity i = 0; i < 6; ++i) {
            const auto count = std::count_if(result.population.begin(), result.population.end(),
                                             [&](const auto& each) { return each.identity == i; });
            CHECK(std::abs(static_cast<double>(count) - 6 * static_cast<double>(i) / 15) < 1);
        }
    }
}

TEST_CASE(
    "linear ranking gives the best its pressure and the worst two less it, whatever the fitness values") {
    const auto counts = chosen(rank(1.8), 5, 4000);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(counts[i] == Approx(0.2 + 1.6 * static_cast<double>(i) / 4).margin(5 * std::sqrt(0.25 / 4000)));
    CHECK_THROWS_WITH(rank(3), "stage 'rank': pressure is '3'; expected a number from 1.0001 to 2");
}

TEST_CASE("random keeps n different individuals, each with equal chance") {
    std::vector<double> counts(5);
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const auto result = run(at_random(2) | score(), Given{}, Given::of({0, 1, 2, 3, 4}), {.seed = seed});
        REQUIRE(result.population.size() == 2);
        CHECK(result.population[0].identity != result.population[1].identity);
        for (const auto& each : result.population)
            counts[each.identity] += 1.0 / 4000;
    }
    for (const double count : counts)
        CHECK(count == Approx(0.4).margin(5 * std::sqrt(0.24 / 4000)));
}

TEST_CASE("best keeps the best first and failed individuals last") {
    const auto result = run(score() | best(9), Given{}, Given::of({2, std::nan(""), 3, 1, 3}));
    std::vector<Identity> order;
    for (const auto& each : result.population)
        order.push_back(each.identity);
    CHECK(order == std::vector<Identity>{2, 4, 0, 3, 1});
    CHECK_THROWS_AS(best(0), UsageError);
}

TEST_CASE("below keeps those under the threshold in their order") {
    const auto result = run(score() | below(2.5), Given{}, Given::of({2, 5, 1, 3}));
    REQUIRE(result.population.size() == 2);
    CHECK(result.population[0].identity == 0);
    CHECK(result.population[1].identity == 2);
    CHECK(run(score() | below(0, at_least(2)), Given{}, Given::of({2, 5, 1, 3})).population[1].identity == 2);
    const auto enough = run(score() | above(2.5, at_least(2)), Given{}, Given::of({2, 3, 1, 5}));
    REQUIRE(enough.population.size() == 2);
    CHECK(enough.population[0].identity == 1); // in their order, not the best first
    CHECK(enough.notes.empty());
}

TEST_CASE("what chooses in proportion to the fitness is refused where there is no one number") {
    CheckState ranked;
    ranked.scored = "pareto f g";
    CHECK_THROWS_WITH(roulette().check(ranked), Catch::Contains("one objective"));
    CHECK_THROWS_WITH(sus().check(ranked), Catch::Contains("one objective"));
    CHECK_NOTHROW(rank(1.5).check(ranked));
}
