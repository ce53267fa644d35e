// Real vectors: Rastrigin's function with one objective, ZDT1 with two.

#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// ZDT1 (Zitzler, Deb and Thiele 2000): both objectives are minimised; the front is f2 = 1 - sqrt(f1).
Vector zdt1(const Vector& x) {
    double g = 0;
    for (std::size_t i = 1; i < x.size(); ++i) g += x[i];
    g = 1 + 9 * g / static_cast<double>(x.size() - 1);
    return {x[0], g * (1 - std::sqrt(x[0] / g))};
}

} // namespace

TEST_CASE("a search finds the minimum of Rastrigin's function among its 10^10 minima") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        CHECK(run("sample 60 | score | until evaluations 30000 fitness 1e-6 "
                  "{ tournament 2 | cross sbx 2 rate=0.9 | mutate 0.1 polynomial 20 | score | plus }",
                  minimum(10, functions::rastrigin, -5.12, 5.12), {}, {.seed = seed})
                  .best->value() < 1e-3);
}

TEST_CASE("NSGA-II covers the known front of ZDT1") {
    Reals problem;
    problem.n = 30, problem.f = zdt1, problem.lower = 0, problem.upper = 1;
    problem.list = {{"f1", [](const Vector& f) { return f[0]; }, true},
                    {"f2", [](const Vector& f) { return f[1]; }, true}};
    const auto result = run("sample 100 | pareto f1 f2 | repeat 250 { tournament 2 | cross sbx rate=0.9 | "
                            "mutate 0.0333333333333 polynomial 20 | parents | pareto f1 f2 | best 100 } | front",
                            problem);
    CHECK(result.population.size() >= 90);
    double generational = 0;
    for (const auto& each : result.population) {
        const Vector f = zdt1(each.genome);
        double nearest = HUGE_VAL;
        for (int k = 0; k <= 1000; ++k)
            nearest = std::min(nearest, std::hypot(f[0] - k / 1000.0, f[1] - (1 - std::sqrt(k / 1000.0))));
        generational += nearest / static_cast<double>(result.population.size());
    }
    CHECK(generational < 1e-2);
    for (int k = 0; k <= 20; ++k) { // no part of the front is left out
        double nearest = HUGE_VAL;
        for (const auto& each : result.population) {
            const Vector f = zdt1(each.genome);
            nearest = std::min(nearest, std::hypot(f[0] - k / 20.0, f[1] - (1 - std::sqrt(k / 20.0))));
        }
        CHECK(nearest < 0.05);
    }
}
