#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// How often each of n individuals, of fitness 0 .. n - 1, is chosen in each of many draws.
Vector chosen(const std::string& selection, std::size_t n, std::size_t size, int draws = 4000) {
    Vector values(n), counts(n);
    std::iota(values.begin(), values.end(), 0.0);
    const auto stage = reals("score | " + selection);
    for (int seed = 0; seed < draws; ++seed) {
        const auto result = run(stage, given(), individuals(values), {.seed = static_cast<std::uint64_t>(seed)});
        REQUIRE(result.population.size() == size);
        for (const auto& each : result.population) counts[each.identity] += 1.0 / draws;
    }
    return counts;
}

std::vector<Identity> kept(const std::string& selection, const Vector& values) {
    std::vector<Identity> order;
    for (const auto& each : run("score | " + selection, given(), individuals(values)).population)
        order.push_back(each.identity);
    return order;
}

} // namespace

TEST_CASE("a tournament of k chooses the i-th worst with probability ((i+1)/n)^k - (i/n)^k") {
    constexpr std::size_t n = 8;
    for (const int k : {1, 2, 5}) {
        const auto counts = chosen("tournament " + std::to_string(k), n, n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto power = [&](std::size_t j) { return std::pow(static_cast<double>(j) / n, k); };
            const double expected = n * (power(i + 1) - power(i));
            CHECK(counts[i] == Approx(expected).margin(5 * std::sqrt(std::max(expected, 0.01) / 4000)));
        }
    }
}

TEST_CASE("a tournament that draws each lets everyone compete equally often") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::array<int, 8> places{}; // even, so that no individual meets itself
        for (const auto& each :
             run("score | tournament 2 draw=each", given(), individuals({0, 1, 2, 3, 4, 5, 6, 7}), {.seed = seed})
                 .population)
            ++places[each.identity];
        CHECK((places[0] == 0 && places[7] == 2));
    }
}

TEST_CASE("roulette and universal sampling choose in proportion to the fitness above the worst") {
    constexpr std::size_t n = 6;
    const auto spun = chosen("roulette", n, n), sampled = chosen("sus", n, n);
    for (std::size_t i = 0; i < n; ++i) {
        const double expected = n * static_cast<double>(i) / 15;
        CHECK(spun[i] == Approx(expected).margin(5 * std::sqrt(std::max(expected, 0.01) / 4000)));
        CHECK(sampled[i] == Approx(expected).margin(5 * std::sqrt(0.25 / 4000)));
    }
}

TEST_CASE("universal sampling differs from the expected count by less than one") {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto result = run("score | sus", given(), individuals({0, 1, 2, 3, 4, 5}), {.seed = seed});
        for (Identity i = 0; i < 6; ++i) {
            const auto count = std::count_if(result.population.begin(), result.population.end(),
                                             [&](const auto& each) { return each.identity == i; });
            CHECK(std::abs(static_cast<double>(count) - 6 * static_cast<double>(i) / 15) < 1);
        }
    }
}

TEST_CASE("linear ranking gives the best its pressure, whatever the fitness values") {
    const auto counts = chosen("rank 1.8", 5, 5);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(counts[i] == Approx(0.2 + 1.6 * static_cast<double>(i) / 4).margin(5 * std::sqrt(0.25 / 4000)));
}

TEST_CASE("equal individuals have equal chances under linear ranking") {
    const auto stage = reals("score | rank 2");
    Vector counts(6);
    for (unsigned seed = 0; seed < 3000; ++seed)
        for (const auto& each : run(stage, given(), individuals({1, 1, 1, 2, 1, 1}), {.seed = seed}).population)
            counts[each.identity] += 1.0 / 3000;
    for (std::size_t i = 0; i < 6; ++i) CHECK(counts[i] == Approx(i == 3 ? 2 : 0.8).margin(0.1));
}

TEST_CASE("random keeps different individuals, each with equal chance") {
    for (const double count : chosen("random 2", 5, 2)) CHECK(count == Approx(0.4).margin(5 * std::sqrt(0.24 / 4000)));
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const auto two = run("random 2 | score", given(), individuals({0, 1, 2, 3, 4}), {.seed = seed}).population;
        CHECK(two[0].identity != two[1].identity);
    }
}

TEST_CASE("a threshold keeps the order of the individuals that pass") {
    CHECK(kept("below 2.5", {2, 5, 1, 3}) == std::vector<Identity>{0, 2});
    CHECK(kept("above 2.5 at_least=2", {2, 3, 1, 5}) == std::vector<Identity>{1, 3});
}

TEST_CASE("a threshold that no individual passes takes the best at_least, or ends the run") {
    const auto result = run("score | above 2 at_least=2", given(), individuals({1, -1, 0}), {.variant = "v"});
    CHECK(result.population.size() == 2);
    CHECK(result.population[1].identity == 2);
    CHECK(result.notes == std::vector<std::string>{"v/above.1: 0 of 3 above 2; took the 2 best"});
    CHECK(run("score | above 2", given(), individuals({1, 0}), {.variant = "v"}).stopped ==
          "v/above.1: 0 of 2 above 2; change the bound, or give at_least=K");
}

TEST_CASE("a selection in proportion to the fitness is refused when there are several objectives") {
    for (const std::string name : {"roulette", "sus"})
        CHECK_THROWS_WITH(run("sample 4 | pareto squares first | " + name + " | score", Reals{}),
                          Catch::Contains("one objective"));
    CHECK_NOTHROW(run("sample 4 | pareto squares first | rank 1.5 | score", Reals{}));
}

TEST_CASE("a replacement keeps the population's size, and elite and plus its best") {
    const std::string children = "tournament 2 | cross uniform | mutate 0.2 | score | ";
    for (const std::string& body : {children + "elite 1", children + "elite 5", children + "plus", children + "plus 20",
                                    std::string("tournament 2 size=2 | cross blend | score | steady")}) {
        CAPTURE(body);
        std::vector<double> bests;
        const Observer<Vector> observer = [&](const auto& event) {
            if (!event.path.ends_with("elite.1") && !event.path.ends_with("plus.1") &&
                !event.path.ends_with("steady.1"))
                return;
            CHECK(event.population.size() == 20);
            bests.push_back(event.population[ranking(event.population)[0]].value());
        };
        run("sample 20 | score | repeat 60 { " + body + " }", Reals{}, {}, {}, {observer});
        CHECK(bests.size() == 60);
        CHECK((body.ends_with("steady") || std::is_sorted(bests.begin(), bests.end())));
        CHECK(bests.back() > bests.front());
    }
}

TEST_CASE("steady replaces the worst by the children, whatever their fitness") {
    const auto zero = transform("zero", [](const Vector&) { return Vector{-7}; });
    const auto body = reals("best 1") | zero | reals("score | steady");
    const auto result = run(reals("score") | repeat(1, body), given(), individuals({3, 1, 2}));
    CHECK(values_of(result.population) == Vector{3, -7, 2});
}

TEST_CASE("distinct and plus with copies=none keep different genomes") {
    CHECK(kept("distinct", {1, 1, 2, 2, 3}) == std::vector<Identity>{0, 2, 4});
    CHECK(kept("distinct 0.5", {1, 1, 2, 2, 3}) == std::vector<Identity>{0, 4}); // half of the width is 1
    const auto all = [](const std::string& plus) {
        return values_of(
            run("score | repeat 1 { score | " + plus + " }", given(), individuals({1, 3, 2, 3, 1})).population);
    };
    CHECK(all("plus 4") == Vector{3, 3, 2, 1});
    CHECK(all("plus 3 copies=none") == Vector{3, 2, 1});
    CHECK(all("plus 5 copies=none") == Vector{3, 2, 1, 3, 1}); // copies fill the other places
    CHECK_THROWS_WITH(reals("plus copies=some"), "pipeline, column 1: stage 'plus': copies is 'some'; use any or none");
}
