#include "domain/mwm/sobol.hpp"
#include "domain/paper/dominance.hpp"
#include "domain/paper/rescaled_problem.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using testing::random_genome;

namespace {

constexpr double p_max = 1.6e-4;

Model paper_model(Index nodes = 512) { return {{nodes, 0.84942, false}, {}, {}, {}}; }

} // namespace

TEST_CASE("the held-out target is met exactly by the genome that made it") {
    const Target target = read_target(RUGOSA_TEST_DATA "/target_heldout.csv");
    DatabaseLayout layout{.pairs = 54, .shortest = 0.84942 / 511};
    const Genome maker = sobol_database(layout).at(53 * 5 + 3);
    const RescaledProblem problem(paper_model(), target, p_max, p_max / 2);
    CHECK(problem.objectives().front().fitness(problem.evaluate(maker)) == Approx(1).margin(1e-9));
}

TEST_CASE("the database on the held-out target scores at best what was measured elsewhere, 0.959") {
    const RescaledProblem problem(paper_model(), read_target(RUGOSA_TEST_DATA "/target_heldout.csv"), p_max,
                                  p_max / 2);
    double best = -1;
    for (const Genome& genome : sobol_database({.shortest = 0.84942 / 511}))
        best = std::max(best, similarity(problem, genome));
    CHECK(best == Approx(0.959).margin(5e-4));
}

TEST_CASE("scoring does not depend on a genome's scale, and settling brings the last pressure to p_max") {
    std::mt19937_64 random(21);
    const RescaledProblem problem(paper_model(128), read_target(RUGOSA_TEST_DATA "/target_paper.csv"), p_max,
                                  p_max / 2);
    for (int i = 0; i < 5; ++i) {
        Genome genome = random_genome(random, 2, 1, 0.84942, 0.05);
        const auto outcome = problem.evaluate(genome);
        const Genome settled = problem.settled(genome, outcome);
        CHECK(problem.key(settled) == problem.key(genome));
        CHECK(problem.evaluate(settled).stiffness.y == outcome.stiffness.y);
        const Response response = respond(settled, problem.model());
        CHECK(response.pressure[response.steps() - 1] == Approx(p_max).epsilon(1e-9));
        const Curve own = secant_stiffness(response);
        CHECK(similarity(problem.target(), own) == Approx(similarity(problem, genome)).margin(1e-9));
    }
}

TEST_CASE("the misfit's derivative follows central differences in every gene, rescaling included") {
    std::mt19937_64 random(22);
    for (int series : {1, 2}) {
        const RescaledProblem problem(paper_model(128), read_target(RUGOSA_TEST_DATA "/target_paper.csv"),
                                      p_max, p_max / 2);
        const Genome genome = random_genome(random, series, 2, 0.84942, 0.06);
        const auto base = problem.sensitivity(genome, "similarity");
        const double largest = base.jacobian.cwiseAbs().maxCoeff();
        const auto values = problem.genes(genome);
        int agreed = 0;
        for (std::size_t g = 0; g < values.size(); ++g) {
            auto up = values, down = values;
            up[g] += 1e-5;
            down[g] -= 1e-5;
            const Eigen::VectorXd difference =
                (problem.sensitivity(problem.with_genes(genome, up), "similarity").residuals -
                 problem.sensitivity(problem.with_genes(genome, down), "similarity").residuals) /
                2e-5;
            agreed += (difference - base.jacobian.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() <
                      1e-5 * largest;
        }
        // A probe across a kink (a contact set, an extreme node, a segment of the curve changes) may differ.
        CHECK(agreed >= static_cast<int>(values.size()) * 2 / 3);
    }
}

TEST_CASE("a target that the problem cannot score is refused") {
    const Target target = read_target(RUGOSA_TEST_DATA "/target_paper.csv");
    CHECK_THROWS_WITH(RescaledProblem(paper_model(), target, 1e-4, 5e-5),
                      Catch::Contains("expected at most max-pressure"));
    CHECK_THROWS_WITH(RescaledProblem(paper_model(), target, p_max, 1e-7), Catch::Contains("low part"));
    CHECK_THROWS_WITH(RescaledProblem(paper_model(), target, p_max, p_max), Catch::Contains("high part"));
    Target bad = target;
    for (double value : {0.0, -1.0, std::nan(""), double(INFINITY)}) {
        bad.pressure[3] = value;
        CHECK_THROWS_WITH(validate(bad), Catch::Contains("point 4: pressure"));
    }
    bad.pressure[3] = bad.pressure[2];
    CHECK_THROWS_WITH(validate(bad), Catch::Contains("point 4: pressure"));
    bad = target;
    bad.stiffness[0] = 0;
    CHECK_THROWS_WITH(validate(bad), Catch::Contains("point 1: stiffness"));
}

TEST_CASE("a genome of one length scale is its own dominant chromosome, and the coarsest of a smooth one is "
          "dominant") {
    const DominanceRule rule(paper_model(256));
    const Genome one{1, {{1, 0.8, 1.5, 0.84942, {{1, {2.0}}}}}};
    CHECK(rule(one).correlation[0][0] == Approx(1));
    CHECK_FALSE(rule(one).only_best);

    Genome smooth{1, {{1, 3.0, 1.8, 0.84942, {{1, {2.0}}, {2, {1.0}}, {3, {0.5}}, {4, {0.1}}}}}};
    CHECK(rule(smooth).at(0, 0));
    CHECK(reduced(smooth, rule(smooth)).series.size() == 1);
}

TEST_CASE("a wave that is flat at the nodes is not dominant and no error") {
    const Model model = paper_model(64);
    const double delta = model.grid.spacing();
    Genome genome{1, {{1, 0.8, 2, 64 * delta, {{1, {2.0}}, {7, {0.4}}}}}}; // n = 7: lambda = delta
    const Dominance dominance = DominanceRule(model)(genome);
    CHECK(std::isnan(dominance.correlation[0][1]));
    CHECK_FALSE(dominance.at(0, 1));
    CHECK(dominance.at(0, 0));
}

TEST_CASE("equal wave numbers of two series are judged as one length scale") {
    const Model model = paper_model(128);
    const Genome genome{1,
                        {{1, 0.8, 1.5, 0.84942, {{1, {2.0}}, {2, {1.0}}}},
                         {0.5, 0.6, 1.7, 0.84942, {{1, {0.3}}, {2, {4.0}}}}}};
    const Dominance dominance = DominanceRule(model)(genome);
    CHECK(dominance.correlation[0][0] == dominance.correlation[1][0]);
    CHECK(dominance.correlation[0][1] != dominance.correlation[1][1]);
}
