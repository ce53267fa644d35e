#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Minimises x + y on a ring of width 0.002 about the circle of radius 2, with y at least 0.1 below the axis.
/// The solution is about (-sqrt 2, -sqrt 2). One violation is in millions, so it dominates a sum.
Reals ring() {
    Reals problem;
    problem.n = 2, problem.lower = -4, problem.upper = 4;
    problem.list = {{"sum", [](const Vector& x) { return x[0] + x[1]; }, true}};
    problem.excess = [](const Vector& x) {
        return Vector{std::abs(x[0] * x[0] + x[1] * x[1] - 4) - 0.002, 1e6 * (x[1] + 0.1)};
    };
    return problem;
}

/// g06 of CEC 2006 (Liang et al.): a crescent between two circles, at most 0.1 wide. Its genes are scaled to
/// -5 to 5. The minimum is -6961.81388.
Reals crescent() {
    Reals problem;
    problem.n = 2, problem.lower = -5, problem.upper = 5;
    problem.f = [](const Vector& x) { return Vector{13 + 8.7 * (x[0] + 5), 10 * (x[1] + 5)}; };
    problem.list = {{"cubes", [](const Vector& y) { return std::pow(y[0] - 10, 3) + std::pow(y[1] - 20, 3); }, true}};
    problem.excess = [](const Vector& y) {
        const double below = std::pow(y[1] - 5, 2);
        return Vector{100 - std::pow(y[0] - 5, 2) - below, std::pow(y[0] - 6, 2) + below - 82.81};
    };
    return problem;
}

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

TEST_CASE("a violation of minus infinity holds, and one of infinity or NaN fails") {
    Reals problem = given();
    problem.excess = [](const Vector& x) { return Vector{x[0]}; };
    for (const double violation : {-HUGE_VAL, HUGE_VAL, std::nan("")}) {
        problem.f = [&](const Vector&) { return Vector{violation}; };
        problem.list = {{"value", [](const Vector&) { return 1.0; }}};
        const Fitness fitness = run("score", problem, individuals({0})).population[0].fitness;
        CHECK(fitness.has_failed() == !(violation < 0));
        CHECK(fitness.feasible() == (violation < 0));
    }
}

TEST_CASE("the epsilon rule finds a thin feasible set more often than Deb's rules") {
    int by_rules = 0, by_levels = 0;
    const auto near = [](const auto& result) {
        return result.best->fitness.feasible() && result.best->value() < -2.82;
    };
    const std::string start = "sample 20 | score | repeat 60 { de | score | ";
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        by_rules += near(run(start + "duel }", ring(), {}, {.seed = seed}));
        by_levels += near(run(start + "epsilon 45 | duel }", ring(), {}, {.seed = seed}));
    }
    CHECK(by_levels > by_rules);
    CHECK(by_levels >= 8);
}

TEST_CASE("levels fall before the population converges outside the feasible set") {
    int solved = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto result = run("sample 36 | score | until fitness -6961.8137 { l-shade evaluations=20000 | score | "
                                "epsilon 300 | duel }",
                                crescent(), {}, {.seed = seed, .budget = {.evaluations = 20000}});
        solved += result.best->fitness.feasible() && result.best->value() < -6961.8137;
    }
    CHECK(solved >= 4); // 0 with levels that depend only on time
}

TEST_CASE("a problem repairs each genome before its evaluation, in resumed runs too") {
    Reals problem = minimum(3, functions::sphere);
    problem.mend = [](Vector x) {
        for (double& gene : x) gene = std::round(gene - 0.5) + 0.5;
        return x;
    };
    std::atomic<int> others = 0;
    problem.f = [&](const Vector& x) {
        others += x != problem.mend(x);
        return Vector{functions::sphere(x)};
    };
    const std::string pipeline =
        "sample 12 | score | repeat 20 { de | score | duel } | refine nlopt LN_COBYLA 30 | best 3";
    const auto whole = run(pipeline, problem);
    CHECK(whole.best->value() == 0.75);
    for (const auto& each : whole.population) CHECK(each.genome == problem.mend(each.genome));
    CHECK(bits_of(in_pieces(pipeline, problem, 50)) == bits_of(whole));
    problem.noise = 1;
    run("sample 12 | average 2 | repeat 5 { mutate 0.5 | average 2 limit=6 | plus }", problem);
    CHECK(others == 0);
}

TEST_CASE("levels of the epsilon rule end with their block, and with a run that is stopped") {
    const auto strict_again = [](const auto& result) {
        for (const auto& each : result.population) {
            double sum = 0;
            for (const double violation : each.fitness.violations()) sum += violation;
            if (each.fitness.violation() != sum) return false;
        }
        return !result.population.empty();
    };
    const std::string pipeline = "sample 20 | score | repeat 5 { mutate 0.5 | score | epsilon 1000 }";
    CHECK(strict_again(run(pipeline, ring())));
    const auto stopped = run(pipeline, ring(), {}, {.budget = {.evaluations = 70}});
    CHECK(!stopped.stopped.empty());
    CHECK(strict_again(stopped));
}

TEST_CASE("refinement by NLopt follows constraints into the feasible set and along its edge") {
    const auto refined = [](const std::string& method, const Vector& start) {
        return run("score | refine nlopt " + method, ring(), population<Vector>({start}));
    };
    const auto found = refined("LN_COBYLA 300", {-3.5, 3}).population[0];
    CHECK(found.fitness.feasible());
    CHECK(found.value() < -2.8);
    CHECK(refined("GN_ISRES 3000", {3, 3}).population[0].fitness.violation() <
          Fitness(sum_of, 0).constrained(ring().excess({3, 3})).violation());
    // without constraints in the method, all points are equal
    CHECK(refined("LN_NELDERMEAD 300", {3, 3}).population[0].genome == Vector{3, 3});
    CHECK(refined("LN_COBYLA 40", {3, 3}).counters.evaluations <= 42);
}
