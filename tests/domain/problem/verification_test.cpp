#include "domain/design/search.hpp"
#include "domain/target/like.hpp"
#include "domain/target/similarity.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

Genome three_waves() { return {1e-3, {{1, 0.9, 1.5, 0.84942, {{1, {0.3}}, {2, {1.0}}, {4, {2.5}}}}}}; }

DesignSetup drawn_setup() {
    DesignSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.contact.solver = Solver::nested;
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    return completed(setup);
}

} // namespace

TEST_CASE("a verification agrees with four separate solutions") {
    for (const bool rescaled : {false, true}) {
        DesignSetup setup = drawn_setup();
        if (rescaled)
            setup.max_pressure = 1.6e-4;
        const auto alone = [&](Index refine, int times) {
            Model model = refined(setup.model, refine);
            model.loading.steps *= times;
            return similarity(setup, respond(setup, three_waves(), model));
        };
        const Verification verified = Verifier(setup).of(three_waves());
        CHECK(verified.similarity == Approx(alone(1, 1)).epsilon(1e-9));
        CHECK(verified.refined == Approx(alone(4, 1)).epsilon(1e-9));
        CHECK(verified.stepped == Approx(alone(1, 4)).epsilon(1e-9));
        CHECK(verified.both == Approx(alone(4, 4)).epsilon(1e-9));
        CHECK(verified.worst() ==
              std::min({verified.similarity, verified.refined, verified.stepped, verified.both}));
        CHECK(verified.stepped != Approx(verified.similarity).epsilon(1e-6));
    }
}

TEST_CASE("a measured profile has similarity 1 to its own response in any load steps") {
    DesignSetup setup = drawn_setup();
    setup.like = sample(three_waves(), setup.model.grid);
    setup.targets = {target_like(*setup.like, setup.model, "itself")};
    const Verification verified = Verifier(setup).of(three_waves());
    CHECK(verified.similarity == Approx(1));
    CHECK(verified.stepped == Approx(1));
    setup.like.reset(); // then only its response in few steps is known
    CHECK(Verifier(setup).of(three_waves()).stepped < 0.999);
}

TEST_CASE("the objectives verified and more_steps agree with the verification and their residuals") {
    const DesignProblem problem(drawn_setup());
    const DesignOutcome outcome = problem.evaluate(three_waves());
    const Verification verified = Verifier(problem.setup()).of(three_waves());
    for (const auto& [name, value] :
         {std::pair("verified", verified.worst()),
          std::pair("more_steps", std::min(verified.similarity, verified.stepped))}) {
        const auto& all = problem.objectives();
        const auto objective = std::find_if(all.begin(), all.end(),
                                            [&, name = name](const auto& one) { return one.name == name; });
        REQUIRE(objective != all.end());
        CHECK(objective->fitness(outcome) == Approx(value).epsilon(1e-9));
        CHECK(1 - problem.sensitivity(three_waves(), name).residuals.cwiseAbs().maxCoeff() ==
              Approx(value).epsilon(1e-9));
    }
}

TEST_CASE("a search with given starts returns an answer at least as good as the first") {
    const DesignSetup setup = drawn_setup();
    SearchOptions options;
    options.pipeline = "shape 8 | score | refine lm 20 | best 1";
    const Answer good = search(setup, options).best;
    options.starts = {good.genome};
    options.pipeline = "mutate 1 | score";
    CHECK(search(setup, options).best.lowest() >= good.lowest() - 1e-9);
}
