// The travelling salesman, with an optimum that is known: towns on a circle.

#include "ga/checkpoint/checkpoint.hpp"
#include "ga/ga.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"

#include <numbers>

using namespace ga;

namespace {

struct Town {
    double x, y;
};

/// A closed tour through all towns; fitness is minus its length.
struct Salesman {
    using Genome = Permutation;
    using Outcome = double;

    std::vector<Town> towns;

    Outcome evaluate(const Permutation& tour) const {
        double length = 0;
        for (std::size_t i = 0; i < tour.size(); ++i) {
            const Town &a = towns[tour.order[i]], &b = towns[tour.order[(i + 1) % tour.size()]];
            length += std::hypot(a.x - b.x, a.y - b.y);
        }
        return length;
    }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {{"short", [](const double& length) { return -length; }}};
        return list;
    }
    bool valid(const Permutation& tour) const { return tour.size() == towns.size(); }
    bool valid_outcome(const double& length) const { return length >= 0; }
    Permutation sample(Stream& stream) const { return Permutation::random(towns.size(), stream); }
};

const auto pipeline = sample(100) | score() |
                      until({.generations = 600, .stagnation = 100},
                            tournament(4) | cross(order(), 0.3) | mutate(0.03, reverse()) | score() | plus());
const Population<Permutation> nobody;

} // namespace

TEST_CASE("a search finds the shortest tour of towns on a circle") {
    Salesman problem;
    constexpr int n = 24;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i * 7 % n) / n;
        problem.towns.push_back({std::cos(angle), std::sin(angle)});
    }
    const double shortest = 2 * n * std::sin(std::numbers::pi / n);
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        CHECK(-run(pipeline, problem, nobody, {.seed = seed}).best->value() == Approx(shortest).epsilon(1e-12));
}

TEST_CASE("a run of permutations resumes to the uninterrupted result, in any memory") {
    const tests::Folder folder;
    const Salesman problem{{{0, 0}, {1, 0}, {3, 0}, {3, 1}, {0, 2}, {2, 2}, {1, 1}}};
    const Pipeline<Salesman> breeding =
        sample(20) | score() |
        repeat(8, tournament(4) | cross(order(), 0.3) | mutate(0.05, reverse()) | score() | plus());
    for (const std::size_t bytes : {std::size_t{1} << 30, std::size_t{3000}}) {
        RunOptions options{.memory_bytes = bytes};
        const auto whole = run(breeding, problem, {}, options);
        Result<Permutation> part;
        for (options.budget.evaluations = 30; part.stopped.empty() == part.population.empty();
             options.budget.evaluations += 30) {
            Checkpoints<Salesman> checkpoints(folder / "run", std::to_string(bytes), options.budget.evaluations > 30);
            part = run(breeding, problem, {}, options, {}, &checkpoints);
        }
        CHECK(json(part.population) == json(whole.population));
        CHECK(json(part.counters) == json(whole.counters));
    }
}

TEST_CASE("a start that is not a permutation is refused") {
    for (const Permutation& wrong : {Permutation{{0, 1, 5}}, Permutation{{1, 1, 2}}})
        CHECK_THROWS_WITH(run(score() | best(1), Salesman{{{0, 0}, {1, 0}, {2, 0}}}, population<Permutation>({wrong})),
                          Catch::Contains("start 1 is not a genome") && Catch::Contains("each of 0 to n - 1 once"));
}
