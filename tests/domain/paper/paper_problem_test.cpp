#include "domain/mwm/sobol.hpp"
#include "domain/paper/variants.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using testing::random_genome;

namespace {

using testing::p_max;

Model paper_model(Index nodes = 512) { return completed({.grid = {nodes}}); }

DesignSetup setup_of(const char* target, Index nodes = 512) {
    return paper_setup(paper_model(nodes), read_target(std::string(RUGOSA_SOURCE "/experiments/targets/") + target),
                       p_max, p_max / 2);
}

} // namespace

TEST_CASE("the genome that made the held-out target meets it exactly") {
    const DatabaseLayout layout{.pairs = 54, .shortest = 0.84942 / 511};
    const DesignProblem problem(setup_of("heldout.csv"));
    CHECK(problem.evaluate(sobol_database(layout).at(53 * 5 + 3)).similarity == Approx(1).margin(1e-9));
}

TEST_CASE("the best of the database meets the held-out target to 0.959, as an independent code does") {
    double best = -1;
    for (const Genome& genome : sobol_database({.shortest = 0.84942 / 511}))
        best = std::max(best, similarity(setup_of("heldout.csv"), genome));
    CHECK(best == Approx(0.959).margin(5e-4));
}

TEST_CASE("the score does not depend on the scale, and the final genome reaches p_max") {
    std::mt19937_64 random(21);
    const DesignProblem problem(setup_of("drawn.csv", 128));
    for (int i = 0; i < 5; ++i) {
        const Genome genome = random_genome(random, 2, 1, 0.84942, 0.05);
        const auto outcome = problem.evaluate(genome);
        const Genome final_genome = problem.final_genome(genome, outcome);
        CHECK(problem.key(final_genome) == problem.key(genome));
        CHECK(problem.evaluate(final_genome).misfits == outcome.misfits);
        const Response response = respond(final_genome, problem.setup().model);
        CHECK(response.pressure[response.steps() - 1] == Approx(p_max).epsilon(1e-9));
        CHECK(similarity(problem.setup().targets[0], secant_stiffness(response)) ==
              Approx(similarity(problem.setup(), genome)).margin(1e-9));
    }
}

TEST_CASE("a reported similarity has nine exact digits by any solver") {
    std::mt19937_64 random(23);
    DesignSetup setup = setup_of("drawn.csv", 128);
    double error = 0;
    for (int i = 0; i < 3; ++i) {
        const Genome genome = random_genome(random, 2, 1, 0.84942, 0.01);
        setup.model.contact.solver = Solver::nested;
        const double exact = similarity(setup, genome, 4);
        setup.model.contact.solver = Solver::active_set;
        setup.model.contact.tolerance = 1e-4;
        error = std::max(error, std::abs(similarity(setup, genome, 4) - exact));
        CHECK(similarity(as_reported(setup), genome, 4) == Approx(exact).margin(1e-9));
    }
    CHECK(error > 1e-9); // the solver's tolerance is coarser
}

TEST_CASE("parts are dominant by the correlation of their curves") {
    const auto curve = [](Eigen::VectorXd x, Eigen::VectorXd y) { return Curve{x, y, 0, x.tail(1)[0]}; };
    const Curve whole = curve(Eigen::Vector4d(1, 2, 3, 4), Eigen::Vector4d(1, 2, 2, 2));
    const std::vector<std::optional<Curve>> parts{
        curve(Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 6)),              // the whole's course, held from 2 on
        std::nullopt,                                                     // flat
        curve(Eigen::Vector4d(1, 2, 3, 4), Eigen::Vector4d(1, 1, 1, 3)),  // late
        curve(Eigen::Vector4d(1, 2, 3, 4), Eigen::Vector4d(7, 7, 7, 7))}; // without variance
    const DominantParts found = dominant_parts(whole, parts);
    CHECK(found.correlation[0] == Approx(1));
    CHECK(found.correlation[2] == Approx(1.0 / 3));
    CHECK(std::isnan(found.correlation[1]));
    CHECK(std::isnan(found.correlation[3]));
    CHECK(found.dominant == std::vector<char>{1, 0, 0, 0});
    CHECK_FALSE(found.only_best);
    const DominantParts best = dominant_parts(whole, {parts[2], parts[3]});
    CHECK(best.only_best);
    CHECK(best.dominant == std::vector<char>{1, 0});
    CHECK(dominant_parts(whole, {parts[1], parts[3]}).dominant == std::vector<char>{1, 1});
    const std::vector<std::optional<Curve>> stretched{
        curve(Eigen::Vector4d(10, 20, 30, 40), Eigen::Vector4d(1, 2, 2, 2))};
    CHECK(std::isnan(dominant_parts(whole, stretched).correlation[0]));
}

TEST_CASE("the coarsest chromosome of a smooth genome is dominant, and a single one always") {
    const DominanceRule rule(paper_model(256));
    const Genome one{1, {{1, 0.8, 1.5, 0.84942, {{1, {2.0}}}}}};
    CHECK(rule(one).correlation[0] == Approx(1));
    CHECK_FALSE(rule(one).only_best);
    const Genome smooth{1, {{1, 3.0, 1.8, 0.84942, {{1, {2.0}}, {2, {1.0}}, {3, {0.5}}, {4, {0.1}}}}}};
    CHECK(rule(smooth).at(0, 0));
    CHECK(reduced(smooth, rule(smooth)).series.size() == 1);
}

TEST_CASE("equal wavenumbers of two series are one length scale") {
    const Genome genome{
        1, {{1, 0.8, 1.5, 0.84942, {{1, {2.0}}, {2, {1.0}}}}, {0.5, 0.6, 1.7, 0.84942, {{1, {0.3}}, {2, {4.0}}}}}};
    const Dominance dominance = DominanceRule(paper_model(128))(genome);
    CHECK(dominance.scales[0].members.size() == 2);
    CHECK(dominance.correlation.size() == 3);
}
