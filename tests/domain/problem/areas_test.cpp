#include "domain/design/search.hpp"
#include "tests/domain/problem/jacobian.hpp"

using namespace rough;
using rough::testing::check_jacobian;
using rough::testing::fitted_genome;

namespace {

DesignSetup area_setup(Kernel kernel, Index columns = 18, Index rows = 16) {
    return {.model = completed({{.nodes = columns, .length = 0.84942, .rows = rows, .width = 0.8}, {kernel}, {8}}),
            .targets = {read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")},
            .limits = {.shortest_wave = 0.25}};
}

/// A chromosome of two crossed ridges: Z = -G [cos(k x + 0.4) + cos(k y + 1)] and a constant.
Genome crossed_waves(double lambda) { return {0.02, {{1, 0.8, 1.5, lambda, {{1, {0.4, 1}}}}}}; }

} // namespace

TEST_CASE("derivatives of misfits on maps agree with differences in every gene", "[areas]") {
    std::mt19937_64 random(71);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic})
        for (const bool free_amplitude : {false, true}) {
            DesignSetup setup = area_setup(kernel);
            if (!free_amplitude) setup.max_pressure = 1.6e-4;
            check_jacobian(setup, fitted_genome(random, setup, 3), "similarity");
        }
    random.seed(72);
    for (const Quantity quantity : {Quantity::interface_stiffness, Quantity::area_at_pressure,
                                    Quantity::area_at_displacement, Quantity::load_at_displacement}) {
        INFO("quantity " << name_of(quantity));
        DesignSetup setup = area_setup(Kernel::free);
        Target& target = setup.targets[0];
        target = {quantity, "", Eigen::VectorXd::LinSpaced(8, 1e-5, 2e-4), Eigen::VectorXd::LinSpaced(8, 0.05, 0.6)};
        if (quantity == Quantity::load_at_displacement) target.y = 0.6 * target.x;
        if (quantity == Quantity::interface_stiffness) target.y = Eigen::VectorXd::LinSpaced(8, 0.5, 4);
        // A smooth contact fraction is steep just before a node touches, and differences are less accurate.
        check_jacobian(setup, fitted_genome(random, setup, 3), "similarity",
                       is_contact_fraction(quantity) ? 1e-4 : 1e-5);
    }
}

TEST_CASE("a map's verification agrees with four separate solutions", "[areas]") {
    std::mt19937_64 random(73);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        DesignSetup setup = area_setup(kernel, 18, 16);
        setup.model.loading.steps = 20;
        setup.max_pressure = 1.6e-4;
        setup.model.contact.tolerance = 1e-9;
        const Genome genome = fitted_genome(random, setup, 3);
        const auto [similarity, refined, stepped, both] = rough::testing::separate_similarities(setup, genome);
        const Verification verified = Verifier(setup).of(genome);
        CHECK(verified.similarity == Approx(similarity).epsilon(1e-6));
        CHECK(verified.refined == Approx(refined).epsilon(1e-6));
        CHECK(verified.more_steps == Approx(stepped).epsilon(1e-6));
        CHECK(verified.both == Approx(both).epsilon(1e-6));
        CHECK(verified.worst <= verified.both);
        CHECK(verified.both == Verifier(setup, 2).of(genome).both);
        CHECK(verified.on_finer[0].steps() == 20);
    }
}

TEST_CASE("a stopped verification of a map has only the similarities solved before", "[areas]") {
    std::mt19937_64 random(75);
    DesignSetup setup = area_setup(Kernel::periodic);
    setup.max_pressure = 1.6e-4;
    const Genome genome = fitted_genome(random, setup, 3);
    const Verification whole = Verifier(setup).of(genome);
    long count = 0;
    const auto stopped_after = [&](long questions) {
        DesignSetup ends = setup;
        ends.model.contact.stop = [&count, questions] { return ++count > questions; };
        count = 0;
        return Verifier(ends).of(genome);
    };
    CHECK(stopped_after(1000000).worst == whole.worst);
    const Verification late = stopped_after(count - 1); // in the last step of the finer grid
    CHECK(late.similarity == whole.similarity);
    CHECK(late.more_steps == whole.more_steps);
    CHECK(late.on_grid[0].pressure == whole.on_grid[0].pressure);
    CHECK((std::isnan(late.refined) && std::isnan(late.both) && std::isnan(late.worst)));
    CHECK(late.on_finer.empty());
    const Verification at_once = stopped_after(0);
    CHECK((std::isnan(at_once.similarity) && std::isnan(at_once.more_steps) && std::isnan(at_once.worst)));
    CHECK(at_once.on_grid.empty());
}

TEST_CASE("a stopped evaluation of a map is reported as stopped, not as a failed genome", "[areas]") {
    std::mt19937_64 random(76);
    DesignSetup setup = area_setup(Kernel::periodic);
    const Genome genome = fitted_genome(random, setup, 3);
    setup.model.contact.stop = [] { return true; };
    const DesignProblem problem(setup);
    for (const ga::Level level : {level::search, level::verified, level::made})
        CHECK_THROWS_AS(problem.evaluate(genome, level), ga::Stopped);
}

TEST_CASE("margins of two crossed waves are the slope, height and radius of both", "[areas]") {
    const double L = 0.84942;
    const Grid grid{33, L, false, 0, 33, L};
    const Genome genome = crossed_waves(L / 2);
    const Series& series = genome.series[0];
    const double G = genome.scale * amplitude(series, 1, 2), k = wave_number(series, 1);
    const auto found = margins(genome, grid, {});
    CHECK(found[1].value == Approx(std::sqrt(2) * G * k).epsilon(1e-2));
    CHECK(found[2].value == Approx(4 * G).epsilon(1e-2));
    CHECK(found[3].value == Approx(1 / (G * k * k)).epsilon(1e-2));
    CHECK(found[1].value >= std::sqrt(2) * G * k);
    CHECK(found[2].value >= 4 * G);
    CHECK(found[3].value <= 1 / (G * k * k));
}

TEST_CASE("no finer map shows a gradient or a height beyond the margins", "[areas]") {
    std::mt19937_64 random(74);
    for (const bool periodic : {false, true}) {
        const Grid grid{24, 0.84942, periodic, 0, 20, 0.8};
        const Genome genome = testing::random_genome(random, 2, 3, 0.84942, 0.25);
        const auto margin = margins(genome, grid, {});
        const Profile fine = sample(genome, refined(grid, 16));
        const auto [columns, rows] = fine.shape();
        const auto z = fine.heights.reshaped(columns, rows);
        const Eigen::ArrayXXd x = (z.bottomRows(columns - 1) - z.topRows(columns - 1)) / fine.spacing,
                              y = (z.rightCols(rows - 1) - z.leftCols(rows - 1)) / fine.row_spacing;
        const double steepest = (x.leftCols(rows - 1).square() + y.topRows(columns - 1).square()).sqrt().maxCoeff();
        const double height = z.maxCoeff() - z.minCoeff();
        CHECK(steepest <= margin[1].value * (1 + 1e-3)); // differences at a corner are not at one point
        CHECK(steepest > 0.95 * margin[1].value);
        CHECK(height <= margin[2].value);
        CHECK(height > 0.97 * margin[2].value);
    }
}

TEST_CASE("rows of limits on a map's shape agree with differences", "[areas]") {
    std::mt19937_64 random(75);
    DesignSetup setup = area_setup(Kernel::free);
    setup.max_pressure = 1.6e-4;
    const DesignProblem problem(setup);
    Genome genome = fitted_genome(random, setup, 3);
    genome = problem.final_genome(genome, problem.evaluate(genome));
    const auto has = margins(genome, setup.model.grid, {});
    setup.limits = {setup.limits.shortest_wave, 0.8 * has[1].value, 0.7 * has[2].value, 1.2 * has[3].value};
    CHECK(DesignProblem(setup).evaluate(genome).excess > 0.5);
    check_jacobian(setup, genome, "similarity");
}

TEST_CASE("a map's verdict is at most its similarity on a grid and in load steps four times finer still",
          "[areas][long]") {
    for (const char* target : {"drawn", "heldout"})
        for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
            INFO(target << ", seed " << seed);
            DesignSetup setup = area_setup(Kernel::free, 32, 32);
            setup.targets = {read_target(RUGOSA_SOURCE "/experiments/targets/" + std::string(target) + ".csv")};
            setup.max_pressure = 1.6e-4;
            setup.model.loading.steps = 20;
            const Answer found = search(setup, {.pipeline = "shape 6 | score | best 2 | refine lm 15",
                                                .seed = seed,
                                                .alternatives = 1,
                                                .verifying = 1})
                                     .best;
            const double truth = rough::testing::similarity_about_points(setup, found.genome, 16, 64);
            WARN(target << ", seed " << seed << ": similarity_worst " << found.worst << ", similarity " << truth);
            CHECK(found.worst <= truth);
            CHECK(truth - found.worst < 0.03);
        }
}
