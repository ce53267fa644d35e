#include "domain/design/search.hpp"
#include "domain/design/tolerance.hpp"
#include "tests/domain/problem/jacobian.hpp"

using namespace rough;
using rough::testing::fitness;

namespace {

constexpr double noise_length = 0.84942 / 60;

DesignSetup setup_with(bool eq_11, const MakingErrors& errors = {.noise_length = noise_length}) {
    DesignSetup setup = rough::testing::drawn_setup(96, eq_11);
    setup.errors = errors;
    return setup;
}

Genome random_start(const DesignSetup& setup) {
    std::mt19937_64 random(41);
    return rough::testing::fitted_genome(random, setup);
}

} // namespace

TEST_CASE("derivatives of misfits under noise and tilt agree with differences") {
    for (const bool eq_11 : {false, true}) {
        const DesignSetup setup = setup_with(eq_11, {2e-6, noise_length, 1e-5});
        const DesignProblem problem(setup);
        const Genome start = random_start(setup), genome = problem.final_genome(start, problem.evaluate(start));
        const ga::Sensitivity all = problem.sensitivity(genome, "made");
        const CommonErrors errors(setup);
        CHECK(errors.noise.size() == 72); // three draws for four of 96 nodes
        const auto points = static_cast<std::size_t>(setup.targets[0].points());
        REQUIRE(static_cast<std::size_t>(all.residuals.size()) ==
                (1 + errors.noise.size() + errors.tilts.size()) * points);
        const double largest = all.jacobian.cwiseAbs().maxCoeff();
        const auto values = problem.genes(genome);
        double agreeing = 0; // entries without a change of a contact set in between
        for (std::size_t g = 0; g < values.size(); ++g) {
            const double h = 1e-7 * std::max(1.0, std::abs(values[g]));
            const auto residuals = [&](double step) {
                const Genome at = problem.with_genes(genome, rough::testing::moved(values, g, step));
                return problem.sensitivity(at, "made").residuals;
            };
            const Eigen::ArrayXd error =
                (residuals(h) - residuals(-h)).array() / (2 * h) - all.jacobian.col(static_cast<Index>(g)).array();
            agreeing += static_cast<double>((error.abs() < 1e-5 * largest).count());
        }
        CHECK(agreeing > 0.95 * static_cast<double>(all.jacobian.size()));
    }
}

TEST_CASE("the objective made is the similarity without errors, and tends to it with small ones") {
    for (const bool eq_11 : {false, true}) {
        const DesignSetup plain = setup_with(eq_11);
        const Genome genome = random_start(plain);
        const double similarity = fitness(DesignProblem(plain), genome, "similarity");
        CHECK(fitness(DesignProblem(plain), genome, "made") == similarity);
        const DesignProblem nearly(setup_with(eq_11, {1e-13, noise_length, 1e-13})),
            far(setup_with(eq_11, {2e-6, noise_length, 0}));
        CHECK(fitness(nearly, genome, "made") == Approx(similarity).margin(1e-5));
        CHECK(fitness(far, genome, "made") < similarity - 1e-3);
    }
}

TEST_CASE("a design under noise loses a third less to it, with equal bits on two threads") {
    DesignSetup setup = setup_with(true);
    setup.targets[0].y = 0.5 + 0.6 * (setup.targets[0].x.array() / 1.6e-4).pow(0.7);
    const std::string start = "shape 12 | score | best 4 | refine lm 12 | ";
    const Genome plain = search(setup, {.pipeline = start + "best 2 | refine lm 20 | best 1"}).best.genome;
    setup.errors.noise = 7e-7;
    const auto under_noise = [&](int threads) {
        return search(setup, {.pipeline = start + "score made | best 2 | refine lm 12", .threads = threads});
    };
    const SearchResult one = under_noise(1), two = under_noise(2);
    CHECK(shape_key(one.best.genome) == shape_key(two.best.genome));
    CHECK(one.best.genome.scale == two.best.genome.scale);
    CHECK(one.best.lowest() == std::min(one.best.worst, one.best.similarity_made));
    const auto fresh = [&](const Genome& genome) {
        return similarity_under_errors(setup, genome, {.seed = 77, .draws = 400});
    };
    CHECK(fresh(one.best.genome) == Approx(one.best.similarity_made).margin(0.02));
    CHECK(1 - fresh(one.best.genome) < 0.65 * (1 - fresh(plain)));
    REQUIRE(!one.made.empty());
    for (std::size_t i = 1; i < one.made.size(); ++i) // none dominates another
        CHECK((one.made[i].similarity <= one.made[i - 1].similarity &&
               one.made[i].similarity_made > one.made[i - 1].similarity_made));
}
