#include "ga/adaptation/differential_evolution.hpp"
#include "ga/adaptation/epsilon.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/ga.hpp"
#include "ga/refinement/refinement.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

/// Minimises x + y on a ring of width 0.002 about the circle of radius 2 with y at least 0.1 below the axis:
/// the answer is about (-sqrt 2, -sqrt 2). One violation is in millions, so that a sum would not see others.
struct Ring {
    using Genome = std::vector<double>;
    using Outcome = std::array<double, 2>;

    std::vector<Objective<Outcome>> list = {{"sum", [](const Outcome& o) { return o[0] + o[1]; }, true}};

    Outcome evaluate(const Genome& x) const { return {x[0], x[1]}; }
    const std::vector<Objective<Outcome>>& objectives() const { return list; }
    std::vector<double> violation(const Outcome& o) const {
        const double off = std::abs(o[0] * o[0] + o[1] * o[1] - 4);
        return {off - 0.002, 1e6 * (o[1] + 0.1)};
    }
    std::vector<Variable> bounds(const Genome&) const { return {{0, -4, 4}, {1, -4, 4}}; }
    Genome sample(Stream& stream) const { return {stream.uniform(-4, 4), stream.uniform(-4, 4)}; }
};

const Name sum_of("sum");

} // namespace

TEST_CASE("a fitness keeps each violation and sums what exceeds their levels") {
    const Fitness fitness = Fitness(sum_of, 1, true).constrained({0.5, -3, 2});
    CHECK(fitness.violations() == std::vector<double>{0.5, 0, 2});
    CHECK(fitness.violation() == 2.5);
    CHECK(fitness.relaxed({1, 0, 1.5}).violation() == 0.5);
    CHECK(fitness.relaxed({1, 0, 2}).feasible());
    CHECK(fitness.relaxed({1, 0, 2}).relaxed({}).violation() == 2.5);
    CHECK(fitness.value() == 1);
    CHECK(Fitness(sum_of, 1).constrained({-1, 0}).feasible());
    CHECK(Fitness(sum_of, Point{1, 2}).constrained({3}).values() == Point{1, 2});
}

TEST_CASE("the epsilon rule finds a thin feasible set more often than Deb's rules") {
    int by_rules = 0, by_levels = 0;
    const auto near = [](const auto& result) {
        return result.best->fitness.feasible() && result.best->value() < -2.82;
    };
    const auto vary = differential_evolution() | score();
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        by_rules +=
            near(run<Ring>(sample(20) | score() | repeat(60, vary | duel()), Ring{}, {}, {.seed = seed}));
        by_levels += near(run<Ring>(sample(20) | score() | repeat(60, vary | epsilon(45) | duel()), Ring{},
                                    {}, {.seed = seed}));
    }
    CHECK(by_levels > by_rules);
    CHECK(by_levels >= 8);
}

TEST_CASE("levels of the epsilon rule end with their block, and with a run that is stopped") {
    const auto strict_again = [](const auto& result) {
        for (const auto& each : result.population) {
            double sum = 0;
            for (const double violation : each.fitness.violations())
                sum += violation;
            if (each.fitness.violation() != sum)
                return false;
        }
        return !result.population.empty();
    };
    const auto body = mutate(0.5) | score() | epsilon(1000);
    CHECK(strict_again(run<Ring>(sample(20) | score() | repeat(5, body), Ring{}, {})));
    RunOptions options;
    options.budget.evaluations = 70;
    const auto stopped = run<Ring>(sample(20) | score() | repeat(5, body), Ring{}, {}, options);
    CHECK(!stopped.stopped.empty());
    CHECK(strict_again(stopped));
}

TEST_CASE("violations and levels survive a checkpoint") {
    Individual<std::vector<double>> individual;
    individual.fitness = Fitness(sum_of, 0.1, true).constrained({0.3, 1}).relaxed({0.1, 0.5});
    const auto again = json(individual).get<Individual<std::vector<double>>>().fitness;
    CHECK(again.violation() == individual.fitness.violation());
    CHECK(again.violations() == individual.fitness.violations());
    CHECK(again.minimises());
}

TEST_CASE("refinement by NLopt follows constraints into the feasible set and along its edge") {
    const auto refined = [](const std::string& algorithm, std::vector<double> start, int evaluations) {
        return run<Ring>(score() | refine(nlopt_method(algorithm, evaluations)), Ring{},
                         population<Ring::Genome>({start}))
            .population[0];
    };
    const auto found = refined("LN_COBYLA", {-3.5, 3}, 300);
    CHECK(found.fitness.feasible());
    CHECK(found.value() < -2.8);
    CHECK(refined("GN_ISRES", {3, 3}, 3000).fitness.violation() <
          Fitness(sum_of, 0).constrained(Ring().violation({3, 3})).violation());
    const auto blind = refined("LN_NELDERMEAD", {3, 3}, 300); // takes no constraints: nothing to go by
    CHECK(blind.genome == std::vector<double>{3, 3});
    CHECK(
        run<Ring>(score() | refine(nlopt_method("LN_COBYLA", 40)), Ring{}, population<Ring::Genome>({{3, 3}}))
            .counters.evaluations <= 42);
}
