#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <map>

using namespace ga;

namespace {

const Population<std::vector<double>> nobody = population<std::vector<double>>({{}});

/// Genomes of any kind that cost nothing.
template <class G>
struct Any {
    using Genome = G;
    using Outcome = int;
    int evaluate(const G&) const { return 0; }
    const std::vector<Objective<int>>& objectives() const {
        static const std::vector<Objective<int>> list = {{"none", [](const int&) { return 0.0; }}};
        return list;
    }
};

struct Whole : Any<std::vector<int>> {
    std::vector<Variable> bounds(const std::vector<int>& g) const {
        std::vector<Variable> box;
        for (std::size_t i = 0; i < g.size(); ++i)
            box.push_back({i, -2, 3});
        return box;
    }
};

/// One gene within bounds of one's choice, both genomes' own where they differ.
struct Boxed : Any<std::vector<double>> {
    double lower = -HUGE_VAL, upper = HUGE_VAL;
    std::vector<Variable> bounds(const std::vector<double>&) const { return {{0, lower, upper}}; }
};

/// The largest distance between the draws' distribution and the one they should have (Kolmogorov and
/// Smirnov), in units that 1.95 of a thousand tests exceed once.
double distance(std::vector<double> draws, const auto& distribution) {
    std::sort(draws.begin(), draws.end());
    const auto n = static_cast<double>(draws.size());
    double largest = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const double expected = distribution(draws[i]), i_th = static_cast<double>(i);
        largest = std::max({largest, expected - i_th / n, (i_th + 1) / n - expected});
    }
    return largest * std::sqrt(n);
}

/// First genes of the pairs of children that 4000 equal pairs of parents have, those of each pair in order.
std::vector<std::array<double, 2>> children_of(const auto& way, const Boxed& problem, double x, double y) {
    std::vector<std::vector<double>> parents;
    for (int i = 0; i < 4000; ++i) {
        parents.push_back({x});
        parents.push_back({y});
    }
    const auto born = run(cross(way) | score(), problem, population(parents)).population;
    std::vector<std::array<double, 2>> pairs;
    for (std::size_t i = 0; i < born.size(); i += 2) {
        const double a = born[i].genome[0], b = born[i + 1].genome[0];
        pairs.push_back({std::min(a, b), std::max(a, b)});
    }
    return pairs;
}

std::vector<double> genes_at(const auto& population, std::size_t gene) {
    std::vector<double> genes;
    for (const auto& each : population)
        genes.push_back(each.genome[gene]);
    std::sort(genes.begin(), genes.end());
    return genes;
}

} // namespace

TEST_CASE("every operator on real genes keeps the population's size and the bounds, and marks children") {
    const auto check = [](const auto& variation, bool crosses) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto start = run(sample(31) | score(), Vectors{}, nobody, {.seed = seed}).population;
            const auto result =
                run(repeat(20, variation) | score(), Vectors{}, start, {.seed = seed}).population;
            REQUIRE(result.size() == 31);
            bool changed = false;
            for (std::size_t i = 0; i < result.size(); ++i) {
                for (const double gene : result[i].genome)
                    REQUIRE(std::abs(gene) <= 1);
                if (result[i].genome != start[i].genome) {
                    changed = true;
                    CHECK(result[i].identity != start[i].identity);
                    CHECK(result[i].parents.size() == (crosses ? 2 : 1));
                }
            }
            CHECK(changed);
        }
    };
    check(cross(one_point()), true);
    check(cross(n_points(3)), true);
    check(cross(uniform()), true);
    check(cross(blend(0.5)), true);
    check(cross(sbx(5)), true);
    check(cross(sbx(5), 0.5), true);
    check(mutate(0.3), false);
    check(mutate(0.3, gaussian(0.5)), false);
    check(mutate(0.3, uniform_step(0.5)), false);
    check(mutate(0.3, polynomial(5)), false);
    check(mutate(0.3, reset()), false);
    check(mutate(0.3, swap()), false);
    check(mutate(0.3, reverse()), false);
}

TEST_CASE("cross-over at points and uniform cross-over lose no gene of a position") {
    const auto check = [](const auto& way) {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto start = run(sample(10) | score(), Vectors{}, nobody, {.seed = seed}).population;
            const auto result = run(cross(way) | score(), Vectors{}, start, {.seed = seed}).population;
            for (std::size_t gene = 0; gene < 6; ++gene)
                CHECK(genes_at(result, gene) == genes_at(start, gene));
        }
    };
    check(one_point());
    check(n_points(2));
    check(n_points(5));
    check(n_points(50));
    check(uniform());
}

TEST_CASE("n points cut two genomes into n + 1 pieces that change hands by turns") {
    const std::vector<std::vector<int>> parents = {std::vector<int>(12, 0), std::vector<int>(12, 1)};
    for (const std::size_t n : {1u, 2u, 3u, 7u, 11u})
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            const auto child = run(cross(n_points(n)) | score(), Any<std::vector<int>>{}, population(parents),
                                   {.seed = seed})
                                   .population[0];
            std::size_t changes = 0;
            for (std::size_t i = 0; i + 1 < 12; ++i)
                changes += child.genome[i] != child.genome[i + 1];
            CHECK(changes == n);
        }
}

TEST_CASE("two genes are cut between them, however many cuts are asked for") {
    for (const std::size_t n : {1, 2, 7}) {
        const auto born = run(cross(n_points(n)) | score(), Any<std::vector<int>>{},
                              population<std::vector<int>>({{0, 0}, {1, 1}}))
                              .population;
        CHECK(born[0].genome == std::vector<int>{0, 1});
        CHECK(born[1].genome == std::vector<int>{1, 0});
    }
    CHECK(width({0, -2, 3}) == 5);
    CHECK(width({0, -HUGE_VAL, 3}) == 1); // no bounds, no width
}

TEST_CASE("uniform cross-over exchanges half of the genes on average") {
    const std::vector<std::vector<bool>> parents = {std::vector<bool>(200), std::vector<bool>(200, true)};
    double exchanged = 0;
    std::vector<int> at(200);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto child =
            run(cross(uniform()) | score(), Any<std::vector<bool>>{}, population(parents), {.seed = seed})
                .population[0];
        exchanged += static_cast<double>(std::count(child.genome.begin(), child.genome.end(), true));
        for (std::size_t i = 0; i < 200; ++i)
            at[i] += child.genome[i] ? 1 : 0;
    }
    CHECK(exchanged == Approx(10000).margin(5 * std::sqrt(20000 * 0.25)));
    for (const int times : at) // at every position, by a coin of its own
        CHECK(std::abs(times - 50) < 25);
}

TEST_CASE("simulated binary cross-over keeps the parents' mean and spreads as its density says") {
    struct Line : Any<std::vector<double>> {};
    const std::vector<std::vector<double>> parents = {{-1}, {1}};
    constexpr double eta = 3;
    constexpr int draws = 20000;
    int crossed = 0, inside = 0, exchanged = 0;
    for (std::uint64_t seed = 0; seed < draws; ++seed) {
        const auto children =
            run(cross(sbx(eta)) | score(), Line{}, population(parents), {.seed = seed}).population;
        const double a = children[0].genome[0], b = children[1].genome[0];
        REQUIRE(a + b == Approx(0).margin(1e-12));
        if (std::abs(a) != 1) {
            ++crossed;
            inside += std::abs(a) < 1;
            exchanged += a > 0;
        }
    }
    CHECK(exchanged == Approx(crossed / 2).margin(5 * std::sqrt(crossed * 0.25)));
    CHECK(crossed == Approx(draws / 2).margin(5 * std::sqrt(draws * 0.25)));
    CHECK(inside == Approx(crossed / 2).margin(5 * std::sqrt(crossed * 0.25)));
}

TEST_CASE("mutation changes each gene with its rate") {
    const auto start = population(std::vector(500, std::vector<bool>(40)));
    const auto result = run(mutate(0.05) | score(), Any<std::vector<bool>>{}, start).population;
    double flipped = 0;
    for (const auto& each : result)
        flipped += static_cast<double>(std::count(each.genome.begin(), each.genome.end(), true));
    CHECK(flipped == Approx(1000).margin(5 * std::sqrt(20000 * 0.05 * 0.95)));
    for (const auto& each : run(mutate(1) | score(), Any<std::vector<bool>>{}, start).population)
        CHECK(each.genome == std::vector<bool>(40, true));
    for (const auto& each : run(mutate(0) | score(), Any<std::vector<bool>>{}, start).population)
        CHECK(each.genome == std::vector<bool>(40));
}

TEST_CASE("a whole number is reset to each of its other values with equal chance") {
    const auto start = population(std::vector(1000, std::vector<int>(5, 1)));
    std::map<int, int> counts;
    for (const auto& each : run(mutate(1, reset()) | score(), Whole{}, start).population)
        for (const int gene : each.genome)
            ++counts[gene];
    CHECK(counts.size() == 5);
    CHECK(counts.count(1) == 0);
    for (const auto& [value, count] : counts) {
        CHECK((value >= -2 && value <= 3));
        CHECK(count == Approx(1000).margin(5 * std::sqrt(5000 * 0.16)));
    }
}

TEST_CASE("gaussian steps have their deviation in widths, polynomial steps lie nearer for a greater index") {
    const auto start = population(std::vector(5000, std::vector<double>(6, 0.0)));
    const auto deviation = [&](const auto& way) {
        double sum = 0;
        for (const auto& each : run(mutate(1, way) | score(), Vectors{}, start).population)
            for (const double gene : each.genome)
                sum += gene * gene;
        return std::sqrt(sum / 30000);
    };
    CHECK(deviation(gaussian(0.05)) == Approx(0.1).epsilon(0.03));
    CHECK(deviation(uniform_step(0.05)) == Approx(0.1 / std::sqrt(3)).epsilon(0.03));
    CHECK(deviation(polynomial(100)) < deviation(polynomial(20)) / 3);
}

TEST_CASE("permutations stay permutations") {
    const auto check = [](const auto& variation) {
        std::vector<Permutation> start;
        for (std::uint64_t i = 0; i < 21; ++i) {
            Stream stream(i);
            start.push_back(Permutation::random(13, stream));
        }
        const auto result =
            run(repeat(50, variation) | score(), Any<Permutation>{}, population(start)).population;
        REQUIRE(result.size() == 21);
        bool changed = false;
        for (std::size_t i = 0; i < 20; ++i) {
            auto order = result[i].genome.order;
            changed |= order != start[i].order;
            std::sort(order.begin(), order.end());
            for (std::uint32_t k = 0; k < 13; ++k)
                CHECK(order[k] == k);
        }
        CHECK(changed);
    };
    check(cross(order()));
    check(mutate(0.1));
    check(mutate(0.1, swap()));
    check(mutate(0.1, reverse()));
}

TEST_CASE("order cross-over keeps a piece of one parent in place and the other's order elsewhere") {
    const Permutation a{{0, 1, 2, 3, 4, 5, 6, 7}}, b{{7, 6, 5, 4, 3, 2, 1, 0}};
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const auto child =
            run(cross(order()) | score(), Any<Permutation>{}, population<Permutation>({a, b}), {.seed = seed})
                .population[0]
                .genome;
        std::vector<std::uint32_t> rest;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < 8; ++i)
            if (child.order[i] == a.order[i])
                ++kept;
        CHECK(kept >= 1);
    }
}

TEST_CASE("a mutated unscored individual stays itself") {
    const auto start = population(std::vector(10, std::vector<double>(6, 0.0)));
    for (const auto& each : run(mutate(1) | score(), Vectors{}, start).population) {
        CHECK(each.identity < 10);
        CHECK(each.parents.size() == 0);
    }
}

TEST_CASE(
    "simulated binary cross-over spreads by its published density, for every index and beside a bound") {
    for (const double eta : {1.0, 5.0, 15.0}) {
        const auto spread = [&](double beta) { // Deb and Agrawal 1995
            return beta <= 1 ? 0.5 * std::pow(beta, eta + 1) : 1 - 0.5 * std::pow(beta, -(eta + 1));
        };
        std::vector<double> free, beside;
        for (const auto& [below, above] : children_of(sbx(eta), Boxed{}, 0, 1))
            if (below != 0)
                free.push_back(above - below);
        CHECK(distance(free, spread) < 1.95);
        const double most = 1 + 2 * 0.1; // a child at the bound
        for (const auto& [below, above] : children_of(sbx(eta), Boxed{{}, -0.1}, 0, 1))
            if (below != 0)
                beside.push_back(1 - 2 * below);
        CHECK(distance(beside, [&](double beta) { return spread(beta) / spread(most); }) < 1.95);
        CHECK(free.size() > 1800);
    }
}

TEST_CASE("blend cross-over is uniform as far beyond the parents as alpha says") {
    for (const double alpha : {0.0, 0.3, 1.0}) {
        std::vector<double> genes;
        for (const auto& pair : children_of(blend(alpha), Boxed{}, 2, 3))
            genes.insert(genes.end(), pair.begin(), pair.end());
        CHECK(distance(genes, [&](double x) { return (x - 2 + alpha) / (1 + 2 * alpha); }) < 1.95);
    }
}

TEST_CASE("mutations of real genes have their published densities") {
    const auto start = population(std::vector(8000, std::vector<double>{0.25}));
    const auto steps = [&](const auto& way, double lower = -1, double upper = 1) {
        std::vector<double> genes;
        for (const auto& each : run(mutate(1, way) | score(), Boxed{{}, lower, upper}, start).population)
            genes.push_back(each.genome[0] - 0.25);
        return genes;
    };
    CHECK(distance(steps(gaussian(0.05)), [](double x) { return 0.5 * std::erfc(-x / 0.1 / std::sqrt(2)); }) <
          1.95);
    CHECK(distance(steps(uniform_step(0.05)), [](double x) { return (x + 0.1) / 0.2; }) < 1.95);
    CHECK(distance(steps(reset()), [](double x) { return (x + 1.25) / 2; }) < 1.95);
    for (const double eta : {3.0, 20.0}) // Deb and Goyal 1996
        CHECK(distance(steps(polynomial(eta)), [&](double x) {
                  const double p = eta + 1, below = std::pow(1 - 1.25 / 2, p),
                               above = std::pow(1 - 0.75 / 2, p);
                  return x < 0 ? (std::pow(1 + x / 2, p) - below) / (1 - below) / 2
                               : 1 - (std::pow(1 - x / 2, p) - above) / (1 - above) / 2;
              }) < 1.95);
}

TEST_CASE("bounds that are infinite, differ between parents, or leave a parent outside make no gene a NaN") {
    struct Own : Boxed { // each genome's bounds are its own
        std::vector<Variable> bounds(const std::vector<double>& g) const { return {{0, g[0] - 1, g[0] + 1}}; }
    };
    const auto finite = [](const auto& problem, double x, double y, double low, double high) {
        const auto start = population<std::vector<double>>({{x}, {y}, {x}, {y}});
        for (std::uint64_t seed = 0; seed < 40; ++seed)
            for (const auto& stage : std::vector<Stage<std::remove_cvref_t<decltype(problem)>>>{
                     cross(sbx(2)) | score(), cross(blend()) | score(), mutate(1, polynomial(5)) | score(),
                     mutate(1, gaussian(0.2)) | score(), mutate(1, reset()) | score()})
                for (const auto& each : run(stage, problem, start, {.seed = seed}).population) {
                    REQUIRE(std::isfinite(each.genome[0]));
                    REQUIRE(each.genome[0] >= low);
                    REQUIRE(each.genome[0] <= high);
                }
    };
    finite(Boxed{}, -3, 5, -1e9, 1e9);
    finite(Boxed{{}, 0}, 1, 5, 0, 1e9);
    finite(Boxed{{}, -HUGE_VAL, 0}, -1, -5, -1e9, 0);
    finite(Boxed{{}, 0, 1}, -3, 5, -3, 5);
    finite(Own{}, -3, 5, -1e9, 1e9);
}

TEST_CASE("order cross-over takes the rest in the other's order, from the end of the kept piece on") {
    const Permutation a{{0, 1, 2, 3, 4, 5, 6, 7}}, b{{3, 7, 0, 6, 2, 5, 1, 4}};
    // Davis's definition, for every piece
    std::vector<std::vector<std::uint32_t>> expected;
    for (std::size_t from = 0; from < 8; ++from)
        for (std::size_t to = from + 1; to <= 8; ++to) {
            std::vector<std::uint32_t> rest = b.order, child = a.order;
            std::rotate(rest.begin(), rest.begin() + static_cast<long>(to % 8), rest.end());
            std::erase_if(rest,
                          [&](std::uint32_t gene) { return gene >= from && gene < to; }); // a is the identity
            for (std::size_t i = 0; i < rest.size(); ++i)
                child[(to + i) % 8] = rest[i];
            expected.push_back(child);
        }
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto child =
            run(cross(order()) | score(), Any<Permutation>{}, population<Permutation>({a, b}), {.seed = seed})
                .population[0]
                .genome;
        CHECK(std::find(expected.begin(), expected.end(), child.order) != expected.end());
    }
}

TEST_CASE("of two genes the one may change its place with the other") {
    const auto start = population(std::vector(60, Permutation{{0, 1}}));
    const auto swapped = run(mutate(0.5, swap()) | score(), Any<Permutation>{}, start).population;
    const auto turned = std::count_if(swapped.begin(), swapped.end(),
                                      [](const auto& each) { return each.genome.order[0] == 1; });
    CHECK(turned > 15); // half of them: one gene is drawn, or the other
    CHECK(turned < 45);
}

TEST_CASE("genomes of no gene, one, and fewer than the bounds name are varied as far as they go") {
    /// Bounds of three genes whatever the genome has; the second has no room.
    struct Three : Any<std::vector<double>> {
        std::vector<Variable> bounds(const std::vector<double>&) const {
            return {{0, 0, 1}, {1, 0.5, 0.5}, {2, 0, 1}};
        }
    };
    const auto born = [](const auto& stage, const auto& problem, const auto& genomes) {
        std::vector<typename std::remove_cvref_t<decltype(genomes)>::value_type> all;
        for (const auto& each : run(stage | score(), problem, population(genomes)).population)
            all.push_back(each.genome);
        return all;
    };
    using Reals = std::vector<std::vector<double>>;
    const Reals none = {{}, {}}, one = {{0.25}, {0.75}}, two = {{0.25, 0.5}, {0.75, 0.5}};
    const auto check = [&](const Stage<Three>& stage) {
        CHECK(born(stage, Three{}, none) == none);
        for (const auto& each : born(stage, Three{}, one)) {
            CHECK(each.size() == 1);
            CHECK((each[0] >= 0 && each[0] <= 1));
        }
        for (const auto& each : born(stage, Three{}, two)) {
            CHECK(each.size() == 2);
            CHECK(each[1] == 0.5);
        }
    };
    check(mutate(1));
    check(mutate(1, uniform_step()));
    check(mutate(1, polynomial()));
    check(mutate(1, reset()));
    check(cross(sbx()));
    check(cross(blend()));
    check(cross(uniform()));
    CHECK(born(mutate(1, gaussian()), Three{}, one) != one);
    for (const Stage<Three>& still : {Stage<Three>(mutate(1, swap())), Stage<Three>(mutate(1, reverse())),
                                      Stage<Three>(cross(one_point())), Stage<Three>(cross(n_points(3)))}) {
        CHECK(born(still, Three{}, none) == none);
        CHECK(born(still, Three{}, one) == one);
    }
    CHECK(born(cross(n_points(2)), Three{}, Reals{{1, 2, 3}, {4}}) == Reals{{1, 2, 3}, {4}});
    const std::vector<Permutation> orders = {{{0}}, {{0}}}, unequal = {{{0, 1, 2}}, {{1, 0}}};
    CHECK(born(cross(order()), Any<Permutation>{}, orders) == orders);
    CHECK(born(cross(order()), Any<Permutation>{}, unequal) == unequal);
    CHECK(born(mutate(1), Any<Permutation>{}, orders) == orders);
    /// Whole numbers of which the first has one value, and the third is not there.
    struct Fixed : Any<std::vector<int>> {
        std::vector<Variable> bounds(const std::vector<int>&) const {
            return {{0, 4, 4}, {1, 0, 1}, {2, 0, 9}};
        }
    };
    CHECK(born(mutate(1), Fixed{}, std::vector<std::vector<int>>{{4, 0}}) ==
          std::vector<std::vector<int>>{{4, 1}});
}

TEST_CASE("a problem's own mutation and cross-over at points stand under the common names") {
    struct Own : Any<std::vector<double>> {
        bool mutate(std::vector<double>& genome, double rate, Stream&) const {
            genome[0] += rate;
            return genome[0] < 2;
        }
        void cross_points(std::vector<double>& a, std::vector<double>& b, std::size_t n, Stream&) const {
            a[0] = b[0] = static_cast<double>(n);
        }
    };
    const auto start = run(score(), Own{}, population<std::vector<double>>({{1}, {3}})).population;
    const auto mutants = run(mutate(0.25) | score(), Own{}, start).population;
    CHECK(mutants[0].genome[0] == 1.25);
    CHECK(mutants[0].parents == Parents(0));
    CHECK(mutants[1].identity == 1); // it says that nothing changed
    for (const auto& each : run(cross(n_points(3)) | score(), Own{}, start).population)
        CHECK(each.genome[0] == 3);
    CHECK(run(cross(one_point()) | score(), Own{}, start).population[0].genome[0] == 1);
}
