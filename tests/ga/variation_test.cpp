#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Genomes of any type, with a trivial evaluation.
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
using Bits = Any<std::vector<bool>>;
using Orders = Any<Permutation>;

/// Equal bounds for all genes, or the bounds in `box`.
template <class G>
struct Boxed : Any<G> {
    double lower = -HUGE_VAL, upper = HUGE_VAL;
    std::vector<Variable> box = {};
    std::vector<Variable> bounds(const G& g) const {
        if (!box.empty()) return box;
        std::vector<Variable> all;
        for (std::size_t i = 0; i < g.size(); ++i) all.push_back({i, lower, upper});
        return all;
    }
};
using Box = Boxed<Vector>;

template <class P>
using Couple = std::array<typename P::Genome, 2>;

/// Children of two parents, of stream number `seed`.
template <class P>
Couple<P> crossed(const auto& way, const P& problem, Couple<P> parents, std::uint64_t seed = 1) {
    Stream stream(seed);
    way(problem, parents[0], parents[1], stream);
    return parents;
}
/// A mutant.
template <class P>
typename P::Genome mutated(const auto& way, const P& problem, typename P::Genome genome, double rate = 1,
                           std::uint64_t seed = 1) {
    Stream stream(seed);
    way(problem, genome, Chance(rate), stream);
    return genome;
}

/// The single genes of 4000 pairs of children, those of each pair in order.
std::vector<std::array<double, 2>> children_of(const auto& way, const Box& problem, double x, double y) {
    std::vector<std::array<double, 2>> pairs;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const auto [a, b] = crossed(way, problem, {{{x}, {y}}}, seed);
        pairs.push_back({std::min(a[0], b[0]), std::max(a[0], b[0])});
    }
    return pairs;
}

} // namespace

TEST_CASE("variation keeps a population's size and bounds, and marks children") {
    for (const std::string variation :
         {"cross one_point", "cross n_points 3", "cross uniform", "cross blend", "cross sbx 5", "cross sbx 5 rate=0.5",
          "mutate 0.3", "mutate 0.3 gaussian 0.5", "mutate 0.3 uniform 0.5", "mutate 0.3 polynomial 5",
          "mutate 0.3 reset", "mutate 0.3 swap", "mutate 0.3 reverse", "mutate 0.3 insertion", "mutate 0.3 or_opt"})
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            CAPTURE(variation, seed);
            const auto start = run("sample 31 | score", Reals{}, {}, {.seed = seed}).population;
            const auto result =
                run("repeat 20 { " + variation + " } | score", Reals{}, start, {.seed = seed}).population;
            REQUIRE(result.size() == 31);
            bool changed = false;
            for (std::size_t i = 0; i < result.size(); ++i) {
                for (const double gene : result[i].genome) REQUIRE(std::abs(gene) <= 1);
                if (result[i].genome != start[i].genome) {
                    changed = true;
                    CHECK(result[i].identity != start[i].identity);
                    CHECK(result[i].parents.size() == (variation.starts_with("cross") ? 2 : 1));
                }
            }
            CHECK(changed);
        }
}

TEST_CASE("cross-over of positions only exchanges the genes of a position") {
    const auto check = [](const auto& way) {
        const Box problem;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto [a, b] = crossed(way, problem, {{{1, 2, 3, 4, 5, 6}, {-1, -2, -3, -4, -5, -6}}}, seed);
            for (std::size_t i = 0; i < 6; ++i) {
                CHECK(std::abs(a[i]) == static_cast<double>(i + 1));
                CHECK(a[i] == -b[i]);
            }
        }
    };
    check(one_point()), check(n_points(2)), check(n_points(5)), check(n_points(50)), check(uniform());
}

TEST_CASE("n points cut two genomes into n + 1 alternating pieces") {
    for (const std::size_t length : {2u, 12u})
        for (const std::size_t n : {1u, 2u, 3u, 7u, 11u})
            for (std::uint64_t seed = 0; seed < 30; ++seed) {
                const auto child = crossed(n_points(n), Bits(),
                                           {{std::vector<bool>(length), std::vector<bool>(length, true)}}, seed)[0];
                std::size_t changes = 0;
                for (std::size_t i = 0; i + 1 < length; ++i) changes += child[i] != child[i + 1];
                CHECK(changes == std::min(n, length - 1));
            }
}

TEST_CASE("uniform cross-over exchanges each position with probability 1/2") {
    std::vector<int> at(200);
    int exchanged = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto child =
            crossed(uniform(), Bits(), {{std::vector<bool>(200), std::vector<bool>(200, true)}}, seed)[0];
        for (std::size_t i = 0; i < 200; ++i) at[i] += child[i] ? 1 : 0;
    }
    for (const int times : at) {
        exchanged += times;
        CHECK(std::abs(times - 50) < 25);
    }
    CHECK(exchanged == Approx(10000).margin(5 * std::sqrt(20000 * 0.25)));
}

TEST_CASE("simulated binary cross-over follows its published density, also near a bound") {
    for (const double eta : {1.0, 5.0, 15.0}) {
        const auto spread = [&](double beta) { // Deb and Agrawal 1995
            return beta <= 1 ? 0.5 * std::pow(beta, eta + 1) : 1 - 0.5 * std::pow(beta, -(eta + 1));
        };
        Vector free, beside;
        for (const auto& [below, above] : children_of(sbx(eta), Box{}, 0, 1))
            if (below != 0) {
                CHECK(below + above == Approx(1).epsilon(1e-12)); // the parents' mean
                free.push_back(above - below);
            }
        CHECK(distance(free, spread) < 1.95);
        CHECK(free.size() == Approx(2000).margin(5 * std::sqrt(4000 * 0.25)));
        const double most = 1 + 2 * 0.1; // a child at the bound
        for (const auto& [below, above] : children_of(sbx(eta), Box{{}, -0.1}, 0, 1))
            if (below != 0) beside.push_back(1 - 2 * below);
        CHECK(distance(beside, [&](double beta) { return spread(beta) / spread(most); }) < 1.95);
    }
    int exchanged = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const auto [a, b] = crossed(sbx(3), Box{}, {{{-1}, {1}}}, seed);
        exchanged += a[0] != -1 && a[0] > b[0] ? 1 : 0;
    }
    CHECK(exchanged == Approx(1000).margin(5 * std::sqrt(4000 * 0.25 * 0.75)));
}

TEST_CASE("blend cross-over is uniform as far beyond the parents as alpha says") {
    for (const double alpha : {0.0, 0.3, 1.0}) {
        Vector genes;
        for (const auto& pair : children_of(blend(alpha), Box{}, 2, 3))
            genes.insert(genes.end(), pair.begin(), pair.end());
        CHECK(distance(genes, [&](double x) { return (x - 2 + alpha) / (1 + 2 * alpha); }) < 1.95);
    }
}

TEST_CASE("mutation changes each gene with its rate") {
    double flipped = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const auto bits = mutated(mutate(0).method, Bits(), std::vector<bool>(40), 0.05, seed);
        flipped += static_cast<double>(std::count(bits.begin(), bits.end(), true));
    }
    CHECK(flipped == Approx(1000).margin(5 * std::sqrt(20000 * 0.05 * 0.95)));
    CHECK(mutated(reset(), Bits(), std::vector<bool>(40), 1) == std::vector<bool>(40, true));
    CHECK(mutated(reset(), Bits(), std::vector<bool>(40), 0) == std::vector<bool>(40));
}

TEST_CASE("reset draws each other value of a whole number with equal chance") {
    std::map<int, int> counts;
    const Boxed<std::vector<int>> whole{{}, -2, 3};
    for (std::uint64_t seed = 0; seed < 1000; ++seed)
        for (const int gene : mutated(reset(), whole, std::vector<int>(5, 1), 1, seed)) ++counts[gene];
    CHECK(counts.size() == 5);
    CHECK(counts.count(1) == 0);
    for (const auto& [value, count] : counts) {
        CHECK((value >= -2 && value <= 3));
        CHECK(count == Approx(1000).margin(5 * std::sqrt(5000 * 0.16)));
    }
    const Boxed<std::vector<int>> fixed{{}, 0, 0, {{0, 4, 4}, {1, 0.5, 2.5}, {2, 0, HUGE_VAL}, {3, 0, 9}}};
    CHECK(mutated(reset(), fixed, std::vector<int>{4, 1, 7}) == std::vector<int>{4, 2, 7}); // no fourth gene
}

TEST_CASE("mutations of real genes have their published densities") {
    const auto steps = [](const auto& way, double from = 0.25) {
        Vector genes;
        for (std::uint64_t seed = 0; seed < 8000; ++seed)
            genes.push_back(mutated(way, Box{{}, -1, 1}, Vector{from}, 1, seed)[0] - from);
        return genes;
    };
    const auto normal = [](double x) { return 0.5 * std::erfc(-x / 0.1 / std::sqrt(2)); };
    CHECK(distance(steps(gaussian(0.05)), normal) < 1.95);
    Vector up = steps(gaussian(0.05), 0.95), down = steps(gaussian(0.05), -0.95); // 0.05 before a bound
    std::ranges::transform(down, down.begin(), std::negate());
    for (const Vector& reflected : {up, down})
        CHECK(distance(reflected, [&](double x) { return normal(x) + normal(x - 0.1); }) < 1.95);
    CHECK(distance(steps(uniform_step(0.05)), [](double x) { return (x + 0.1) / 0.2; }) < 1.95);
    CHECK(distance(steps(reset()), [](double x) { return (x + 1.25) / 2; }) < 1.95);
    for (const double eta : {3.0, 20.0}) // Deb and Goyal 1996
        CHECK(distance(steps(polynomial(eta)), [&](double x) {
                  const double p = eta + 1, below = std::pow(1 - 1.25 / 2, p), above = std::pow(1 - 0.75 / 2, p);
                  return x < 0 ? (std::pow(1 + x / 2, p) - below) / (1 - below) / 2
                               : 1 - (std::pow(1 - x / 2, p) - above) / (1 - above) / 2;
              }) < 1.95);
}

TEST_CASE("permutations stay permutations") {
    const auto check = [](const auto& variation) {
        Stream stream(3);
        const Permutation start = Permutation::random(13, stream);
        auto genomes = std::array{start, Permutation::random(13, stream)};
        for (int i = 0; i < 50; ++i) variation(genomes, stream);
        CHECK(genomes[0].order != start.order);
        for (auto& [order] : genomes) {
            std::sort(order.begin(), order.end());
            for (std::uint32_t k = 0; k < 13; ++k) CHECK(order[k] == k);
        }
    };
    check([](auto& genomes, Stream& stream) { order()(Orders(), genomes[0], genomes[1], stream); });
    check([](auto& genomes, Stream& stream) { Natural()(Orders(), genomes[0], Chance(0.1), stream); });
    check([](auto& genomes, Stream& stream) { swap()(Orders(), genomes[0], Chance(0.1), stream); });
    check([](auto& genomes, Stream& stream) { reverse()(Orders(), genomes[0], Chance(0.1), stream); });
}

TEST_CASE("order and partially mapped cross-over keep a piece and follow their definitions elsewhere") {
    const Permutation a{{0, 1, 2, 3, 4, 5, 6, 7}}, b{{3, 7, 0, 6, 2, 5, 1, 4}};
    std::set<std::vector<std::uint32_t>> ordered, mapped, found, found_mapped;
    for (std::size_t from = 0; from < 8; ++from)
        for (std::size_t to = from + 1; to <= 8; ++to) {
            std::vector<std::uint32_t> rest = b.order, child = a.order; // Davis
            std::rotate(rest.begin(), rest.begin() + static_cast<long>(to % 8), rest.end());
            std::erase_if(rest, [&](std::uint32_t gene) { return gene >= from && gene < to; });
            for (std::size_t i = 0; i < rest.size(); ++i) child[(to + i) % 8] = rest[i];
            ordered.insert(child);
            child = b.order; // Goldberg and Lingle: exchanges in the other parent
            for (std::size_t i = from; i < to; ++i) std::swap(child[i], *std::ranges::find(child, a.order[i]));
            mapped.insert(child);
        }
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        found.insert(crossed(order(), Orders(), {{a, b}}, seed)[0].order);
        found_mapped.insert(crossed(pmx(), Orders(), {{a, b}}, seed)[0].order);
    }
    CHECK(found == ordered);
    CHECK(found_mapped == mapped);
}

namespace {

/// The edges of a closed tour, each with the lower number first.
std::set<std::pair<std::uint32_t, std::uint32_t>> edges(const Permutation& tour) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i < tour.size(); ++i)
        edges.insert(std::minmax(tour.order[i], tour.order[(i + 1) % tour.size()]));
    return edges;
}
std::size_t foreign_edges(const Permutation& child, const Permutation& a, const Permutation& b) {
    auto parental = edges(a);
    parental.merge(edges(b));
    std::size_t foreign = 0;
    for (const auto& edge : edges(child)) foreign += parental.contains(edge) ? 0 : 1;
    return foreign;
}

} // namespace

TEST_CASE("samples by Sobol and Latin hypercube have one point in each interval of every gene") {
    for (const std::string method : {"sobol", "latin"}) {
        std::array<Vector, 2> firsts;
        for (const std::uint64_t seed : {1u, 2u}) {
            const auto result = run("sample 64 " + method + " | score", Reals{}, {}, {.seed = seed});
            firsts[seed - 1] = result.population[0].genome;
            for (std::size_t k = 0; k < 6; ++k) {
                std::set<int> intervals;
                for (const auto& each : result.population)
                    intervals.insert(static_cast<int>(std::floor((each.genome[k] + 1) * 32)));
                CHECK((intervals.size() == 64 && *intervals.begin() == 0 && *intervals.rbegin() == 63));
            }
        }
        CHECK(firsts[0] != firsts[1]);
        Reals half; // the second gene has no finite bounds, so the problem draws it
        half.n = 2;
        half.box = [](const Vector&) { return std::vector<Variable>{{0, 2, 3}, {1, 0, HUGE_VAL}}; };
        for (const auto& each : run("sample 9 " + method + " | score", half).population)
            CHECK((each.genome[0] >= 2 && each.genome[0] <= 3 && std::abs(each.genome[1]) <= 1));
    }
    Reals many;
    many.n = 4000;
    CHECK_THROWS_WITH(run("sample 2 sobol | score", many), "sample sobol: 4000 genes exceed 3667; use latin");
}

TEST_CASE("operators on permutations give permutations and few new edges") {
    std::map<std::string, std::array<int, 2>> moves; // changed children, and those of one move
    std::size_t made = 0, unrelated = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Stream stream(seed);
        const std::size_t n = 2 + seed % 30;
        const Permutation a = Permutation::random(n, stream), b = Permutation::random(n, stream);
        const auto check = [&](const auto& way, std::size_t changed_edges) {
            const Permutation child = mutated(way, Orders(), a, 0.2 / static_cast<double>(n), seed);
            REQUIRE(child.is_valid());
            auto& [changed, once] = moves[way.words().name];
            changed += child != a ? 1 : 0;
            once += child != a && foreign_edges(child, a, a) <= changed_edges ? 1 : 0;
        };
        check(swap(), 4), check(reverse(), 2), check(insertion(), 3), check(or_opt(), 3);
        for (const auto& child : crossed(edge(), Orders(), {{a, b}}, seed)) {
            REQUIRE(child.is_valid());
            made += n;
            unrelated += foreign_edges(child, a, b);
        }
        CHECK(edges(crossed(edge(), Orders(), {{a, a}}, seed)[0]) == edges(a));
    }
    for (const auto& [name, count] : moves) {
        CAPTURE(name);
        CHECK(count[0] > 200);
        CHECK(count[1] > 0.85 * count[0]); // more than one move is rare at this rate
    }
    CHECK(distance(Orders(), Permutation{{0, 1, 2, 3}}, Permutation{{1, 0, 2, 3}}) == 0.5);
    CHECK(static_cast<double>(unrelated) < 0.06 * static_cast<double>(made));
}

TEST_CASE("a varied gene is finite when bounds are infinite or a parent is outside") {
    const auto finite = [](const Reals& problem, double x, double y, double low, double high) {
        const auto start = individuals({x, y, x, y});
        for (const std::string variation :
             {"cross sbx 2", "cross blend", "mutate 1 polynomial 5", "mutate 1 gaussian 0.2", "mutate 1 reset"})
            for (std::uint64_t seed = 0; seed < 40; ++seed)
                for (const auto& each : run(variation + " | score", problem, start, {.seed = seed}).population)
                    REQUIRE((each.genome[0] >= low && each.genome[0] <= high));
    };
    Reals problem = given();
    const auto within = [&](double lower, double upper) {
        problem.lower = lower, problem.upper = upper;
        return problem;
    };
    finite(within(-HUGE_VAL, HUGE_VAL), -3, 5, -1e9, 1e9);
    finite(within(0, HUGE_VAL), 1, 5, 0, 1e9);
    finite(within(-HUGE_VAL, 0), -1, -5, -1e9, 0);
    finite(within(0, 1), -3, 5, -3, 5);
    problem.box = [](const Vector& g) { return std::vector<Variable>{{0, g[0] - 1, g[0] + 1}}; };
    finite(problem, -3, 5, -1e9, 1e9); // bounds differ between the parents
}

TEST_CASE("a problem's mutation and cross-over replace the common ones") {
    struct Own : Any<Vector> {
        bool mutate(Vector& genome, double rate, Stream&) const {
            genome[0] += rate;
            return genome[0] < 2;
        }
        void cross_points(Vector& a, Vector& b, std::size_t n, Stream&) const { a[0] = b[0] = static_cast<double>(n); }
    };
    CHECK(mutated(Natural(), Own(), Vector{1}, 0.25) == Vector{1.25});
    CHECK(crossed(n_points(3), Own(), {{{1}, {3}}}) == Couple<Own>{{{3}, {3}}});
    CHECK(crossed(one_point(), Own(), {{{1}, {3}}}) == Couple<Own>{{{1}, {1}}});
}
