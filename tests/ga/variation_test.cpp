#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

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
            const auto child =
                run(cross(n_points(n)) | score(), Any<std::vector<int>>{}, population(parents), {.seed = seed})
                    .population[0];
            std::size_t changes = 0;
            for (std::size_t i = 0; i + 1 < 12; ++i)
                changes += child.genome[i] != child.genome[i + 1];
            CHECK(changes == n);
        }
}

TEST_CASE("uniform cross-over exchanges half of the genes on average") {
    const std::vector<std::vector<bool>> parents = {std::vector<bool>(200), std::vector<bool>(200, true)};
    double exchanged = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto child =
            run(cross(uniform()) | score(), Any<std::vector<bool>>{}, population(parents), {.seed = seed})
                .population[0];
        exchanged += static_cast<double>(std::count(child.genome.begin(), child.genome.end(), true));
    }
    CHECK(exchanged == Approx(10000).margin(5 * std::sqrt(20000 * 0.25)));
}

TEST_CASE("simulated binary cross-over keeps the parents' mean and spreads as its density says") {
    struct Line : Any<std::vector<double>> {};
    const std::vector<std::vector<double>> parents = {{-1}, {1}};
    constexpr double eta = 3;
    constexpr int draws = 20000;
    int crossed = 0, inside = 0;
    for (std::uint64_t seed = 0; seed < draws; ++seed) {
        const auto children = run(cross(sbx(eta)) | score(), Line{}, population(parents), {.seed = seed}).population;
        const double a = children[0].genome[0], b = children[1].genome[0];
        REQUIRE(a + b == Approx(0).margin(1e-12));
        if (std::abs(a) != 1) {
            ++crossed;
            inside += std::abs(a) < 1;
        }
    }
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
        const auto result = run(repeat(50, variation) | score(), Any<Permutation>{}, population(start)).population;
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
