#include "domain/design/search.hpp"
#include "tests/domain/problem/jacobian.hpp"

using namespace rough;

namespace {

Genome three_waves() { return {1e-3, {{1, 0.9, 1.5, 0.84942, {{1, {0.3}}, {2, {1.0}}, {4, {2.5}}}}}}; }

DesignSetup nested_setup(bool eq_11 = false) {
    DesignSetup setup = rough::testing::drawn_setup(64, eq_11);
    setup.model.contact.solver = Solver::nested;
    return setup;
}

} // namespace

TEST_CASE("a verification agrees with four separate solutions") {
    for (const bool eq_11 : {false, true}) {
        const DesignSetup setup = nested_setup(eq_11);
        const auto [similarity, refined, stepped, both] = rough::testing::separate_similarities(setup, three_waves());
        const Verification verified = Verifier(setup).of(three_waves());
        CHECK(verified.similarity == Approx(similarity).epsilon(1e-9));
        CHECK(verified.refined == Approx(refined).epsilon(1e-9));
        CHECK(verified.more_steps == Approx(stepped).epsilon(1e-9));
        CHECK(verified.both == Approx(both).epsilon(1e-9));
        CHECK(verified.worst <= verified.both);
        CHECK(verified.worst == min_similarity(verified.largest));
        CHECK(verified.more_steps != Approx(verified.similarity).epsilon(1e-6));
    }
}

TEST_CASE("a verifier solves a genome once") {
    const Genome genome = testing::two_waves();
    const Verifier verifier(testing::like_itself(genome));
    const double seconds = verifier.of(genome).seconds;
    CHECK(verifier.of(genome).seconds == seconds);
    CHECK(verifier.of(testing::two_waves(0.4)).seconds != seconds);
}

TEST_CASE("a measured profile has similarity 1 to its response in any load steps") {
    DesignSetup setup = nested_setup();
    setup.measured = sample(three_waves(), setup.model.grid);
    setup.targets = {target_like(*setup.measured, setup.model, "itself")};
    const Verification verified = Verifier(setup).of(three_waves());
    CHECK(verified.similarity == Approx(1));
    CHECK(verified.more_steps == Approx(1));
    setup.measured.reset(); // then only its response in few steps is known
    CHECK(Verifier(setup).of(three_waves()).more_steps < 0.999);
}

TEST_CASE("the objective verified and its residuals agree with the verification") {
    const DesignProblem problem(nested_setup());
    const Verification verified = Verifier(problem.setup()).of(three_waves());
    CHECK(rough::testing::fitness(problem, three_waves(), "verified") == Approx(verified.worst).epsilon(1e-9));
    CHECK(1 - problem.sensitivity(three_waves(), "verified").residuals.cwiseAbs().maxCoeff() ==
          Approx(verified.worst).epsilon(1e-9));
}

TEST_CASE("an answer is at least as good as the first start and the best surface seen, on lines and maps") {
    for (const bool map : {false, true}) {
        INFO((map ? "a map" : "a line"));
        DesignSetup setup = nested_setup();
        if (map) {
            setup.model.grid = {.nodes = 16, .length = 0.84942, .rows = 16, .width = 0.84942};
            setup.model = completed({setup.model.grid});
            setup.ridges = 8, setup.limits.shortest_wave = 0.3;
        }
        SearchOptions options;
        options.alternatives = 1;
        options.pipeline = "shape 4 | score | refine lm 6 | best 1";
        const Answer good = search(setup, options).best;
        options.starts = {good.genome};
        for (const char* worse : {"mutate 1 | score", "score | mutate 1 | score"}) {
            options.pipeline = worse;
            CHECK(search(setup, options).best.lowest() >= good.lowest() - 1e-9);
        }
    }
}

TEST_CASE("a smooth area is scored as its derivatives read it, on lines and maps") {
    for (const bool map : {false, true}) {
        DesignSetup setup = nested_setup();
        if (map) setup.model = completed({.grid = {.nodes = 16, .length = 0.84942, .rows = 18, .width = 0.84942}});
        Target& target = setup.targets[0];
        target = {Quantity::area_at_pressure, "", target.x, Eigen::VectorXd::LinSpaced(target.points(), 0.1, 0.6)};
        const auto error = [&] {
            const DesignProblem problem(setup);
            const auto residuals = problem.sensitivity(three_waves(), "similarity").residuals;
            return (problem.evaluate(three_waves()).misfits[0] - residuals).cwiseAbs().maxCoeff();
        };
        CHECK(error() > 1e-3); // a count of nodes
        setup.smooth_area = true;
        CHECK(error() < 1e-9);
    }
}

TEST_CASE("settings that leave little to search are named before it, on lines and maps") {
    for (const bool map : {false, true}) {
        INFO((map ? "a map" : "a line"));
        DesignSetup usual =
            map ? DesignSetup{.model =
                                  completed({.grid = {.nodes = 32, .length = 0.84942, .rows = 32, .width = 0.84942}})}
                : DesignSetup{};
        usual.targets = nested_setup().targets;
        usual.max_pressure = 1.6e-4;
        CHECK(doubts(usual).empty());
        const auto first = [&](auto change) {
            DesignSetup setup = usual;
            change(setup);
            const auto all = doubts(setup);
            return all.empty() ? std::string() : all.front();
        };
        const double spacing = usual.model.grid.widest_spacing();
        CHECK_THAT(first([&](DesignSetup& setup) { setup.limits.shortest_wave = 3.9 * spacing; }),
                   Catch::StartsWith("shortest-wave: "));
        CHECK(first([&](DesignSetup& setup) { setup.limits.shortest_wave = 4 * spacing; }).empty());
        CHECK_THAT(first([&](DesignSetup& setup) { setup.bounds.lambda_to = 3.9 * spacing; }),
                   Catch::StartsWith("lambda-to: "));
        CHECK_THAT(first([](DesignSetup& setup) { setup.limits.max_height = 1e-5; }),
                   Catch::StartsWith("max-height: "));
        CHECK_THAT(first([](DesignSetup& setup) { setup.limits.max_slope = 1e-5; }), Catch::StartsWith("max-slope: "));
        usual.model.body.kernel = Kernel::periodic;
        usual.model.grid.periodic = true;
        usual.model.body.datum.reset();
        usual.model.loading.reach = 1 - 1e-6;
        CHECK_THAT(first([](DesignSetup&) {}), Catch::StartsWith("max-pressure: "));
    }
}

TEST_CASE("the derivatives of the verified misfits predict a move of the gene that matters most") {
    const DesignProblem problem(rough::testing::drawn_setup(512, true));
    const ga::Sensitivity here = problem.sensitivity(three_waves(), "verified");
    const auto values = problem.genes(three_waves());
    CHECK(here.jacobian.col(0).norm() < 1e-9 * here.jacobian.norm()); // the amplitude, which Eq. 11 sets
    double largest = 0, agreement = 0;
    for (std::size_t g = 1; g < values.size(); ++g) {
        const double by = 1e-3 * std::max(1.0, std::abs(values[g]));
        const Genome moved = problem.with_genes(three_waves(), rough::testing::moved(values, g, by));
        const Eigen::VectorXd change = problem.sensitivity(moved, "verified").residuals - here.residuals,
                              expected = here.jacobian.col(static_cast<Index>(g));
        if (change.norm() > largest) largest = change.norm(), agreement = change.dot(expected.normalized()) / largest;
    }
    CHECK(agreement > 0.9);
}

// The stiffness of a line rises steeply when a crest begins to touch. A search uses what a verification does not show.
TEST_CASE("a line's verdict is at most its similarity on a grid and in load steps four times finer still", "[long]") {
    const DesignSetup setup = rough::testing::drawn_setup(512, true);
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        const Answer found = search(setup, {.seed = seed, .alternatives = 1}).best;
        const double truth = rough::testing::similarity_about_points(setup, found.genome, 16, 256);
        WARN("seed " << seed << ": similarity_worst " << found.worst << ", similarity " << truth);
        CHECK(found.worst <= truth);
        CHECK(truth - found.worst < 0.01);
    }
}
