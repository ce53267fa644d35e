#include "domain/design/pipelines.hpp"
#include "tests/domain/problem/jacobian.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("every kind of pipeline keeps bounds and budget, with equal bits on any threads") {
    const DesignSetup setup = rough::testing::drawn_setup(64);
    const DesignProblem problem(setup);
    for (const std::string generation :
         {"tournament 2 | cross n_points 2 | mutate 0.2 | score | elite 1",
          "random | cross sbx 5 | mutate 0.2 | score | crowding", "share 0.3 | mutate 0.5 | score",
          "clear 0.2 | mutate 0.5 | score | plus",
          "tournament 2 | mutate 0.5 | score | map-elites height skewness cells=4",
          "emit 6 slope wavelength | score | map-elites slope wavelength cells=4"}) {
        CAPTURE(generation);
        const auto stage = design_pipeline(setup, "sample 8 | score | repeat 3 { " + generation + " }");
        const auto run_on = [&](int threads, long evaluations) {
            return ga::run(stage, problem, {},
                           {.seed = 5, .threads = threads, .budget = {.evaluations = evaluations}});
        };
        const auto whole = run_on(1, 1000), again = run_on(2, 1000), part = run_on(2, 20);
        CHECK(whole.stopped.empty());
        CHECK(whole.counters.asked > 20);
        CHECK(part.stopped == "evaluation budget spent");
        CHECK(part.counters.asked == 20);
        CHECK(whole.best->value() >= part.best->value());
        REQUIRE(whole.population.size() == again.population.size());
        std::size_t children = 0;
        for (std::size_t i = 0; i < whole.population.size(); ++i) {
            const auto &one = whole.population[i], &other = again.population[i];
            CHECK((one.identity == other.identity && genes(one.genome) == genes(other.genome) &&
                   one.value() == other.value()));
            CHECK_NOTHROW(validate(one.genome, ""));
            for (const Series& series : one.genome.series) {
                CHECK((series.H >= setup.bounds.H_from && series.H <= setup.bounds.H_to));
                CHECK((series.gamma >= setup.bounds.gamma_from && series.gamma <= setup.bounds.gamma_to));
            }
            children += one.parents.size() > 0 ? 1 : 0;
        }
        CHECK(children > 0);
    }
}
