#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "tests/domain/problem/jacobian.hpp"

using namespace rough;
using rough::testing::check_jacobian;
using rough::testing::drawn_setup;
using rough::testing::fitted_genome;

namespace {

/// A target of n points whose x and y grow evenly.
Target straight(Quantity quantity, Index n, double x_from, double x_to, double y_from, double y_to) {
    return {quantity, "", Eigen::VectorXd::LinSpaced(n, x_from, x_to), Eigen::VectorXd::LinSpaced(n, y_from, y_to)};
}

/// The drawn target and a contact area at each of its pressures.
DesignSetup drawn_with_area() {
    DesignSetup setup = drawn_setup(128);
    setup.targets.push_back(straight(Quantity::area_at_pressure, 20, 8e-6, 1.6e-4, 0.05, 0.6));
    return setup;
}

} // namespace

TEST_CASE("derivatives of misfits agree with differences in every gene, with and without Eq. 11") {
    std::mt19937_64 random(31);
    for (const bool free_amplitude : {false, true}) {
        DesignSetup setup = drawn_setup(128, !free_amplitude);
        for (std::size_t ridges : {1u, 2u})
            for (const char* objective : {"similarity", "low", "high"})
                check_jacobian(setup, fitted_genome(random, setup, ridges), objective);
        setup.targets[0].quantity = Quantity::interface_stiffness;
        setup.targets[0].y *= 1.5;
        check_jacobian(setup, fitted_genome(random, setup), "similarity");
    }
    DesignSetup setup = drawn_setup(509, true);
    setup.model.loading.shares = {0.1, 0.2, 0.31, 0.32, 0.33, 0.34, 0.5, 0.62, 0.63, 0.8, 0.9, 0.99, 1};
    check_jacobian(setup, fitted_genome(random, setup), "similarity", 1e-5);
}

TEST_CASE("derivatives agree for contact fractions, and for loads, bands and weights together") {
    std::mt19937_64 random(35);
    for (const Quantity quantity : {Quantity::area_at_pressure, Quantity::area_at_displacement}) {
        DesignSetup setup = drawn_setup(128);
        setup.targets = {straight(quantity, 10, 1e-5, 2e-4, 0.05, 0.6)}; // smooth contact fractions
        check_jacobian(setup, fitted_genome(random, setup), "similarity");
    }
    random.seed(32);
    DesignSetup setup = drawn_setup(128);
    setup.targets.push_back(straight(Quantity::load_at_displacement, 10, 1e-5, 2e-4, 6e-6, 1.2e-4));
    setup.targets[1].weight = 0.4;
    setup.targets[0].lower = 0.97 * setup.targets[0].y;
    setup.targets[0].upper = 1.05 * setup.targets[0].y;
    check_jacobian(setup, fitted_genome(random, setup), "similarity");
}

TEST_CASE("derivatives agree for a periodic profile in full contact before the target ends") {
    std::mt19937_64 random(37);
    for (const Quantity quantity : {Quantity::load_at_displacement, Quantity::stiffness, Quantity::area_at_displacement,
                                    Quantity::area_at_pressure}) {
        DesignSetup setup = drawn_setup(128, false, Kernel::periodic);
        const Genome genome = testing::random_genome(random, 2, 1, setup.model.grid.length, setup.limits.shortest_wave);
        const double full = displacement_range(sample(genome, setup.model.grid), Kernel::periodic);
        const Response plain = respond(genome, setup.model);
        const double last = against_pressure(quantity) ? 4 * plain.pressure.maxCoeff() : 1.5 * full;
        setup.targets = {straight(quantity, 10, 0.1 * last, last, 0.1, 1)};
        Target& target = setup.targets[0];
        if (!is_contact_fraction(quantity)) { // a contact fraction jumps when nodes touch
            target.y *= 10 * (quantity == Quantity::stiffness ? plain.tangent_stiffness[2] : plain.pressure[2]);
            check_jacobian(setup, genome, "similarity");
        }
        // Only a contact fraction can meet its target beyond full contact.
        const Curve met = respond(setup, genome, setup.model).curves.front();
        const double end = met.x[met.x.size() - 2];
        target.y = target.x.unaryExpr([&](double x) { return met.at(std::min(x, end)); });
        const double found = similarity(setup, respond(setup, genome, setup.model));
        if (is_contact_fraction(quantity))
            CHECK(found == Approx(1));
        else
            CHECK(found < 0);
    }
}

TEST_CASE("rows of limits on shape agree with differences, and are 0 within the limits") {
    for (const bool free_amplitude : {false, true}) {
        DesignSetup setup = drawn_setup(128, !free_amplitude);
        DesignProblem problem(setup);
        Genome genome = shaped_start(setup, ga::Stream(5));
        genome = problem.final_genome(genome, problem.evaluate(genome));
        const auto has = margins(genome, setup.model.grid, {});
        CHECK(problem.sensitivity(genome, "similarity").residuals.size() == 20);
        const double wave = setup.limits.shortest_wave;
        setup.limits = {wave, 0.8 * has[1].value, 0.7 * has[2].value, 1.2 * has[3].value};
        check_jacobian(setup, genome, "similarity");
        const DesignProblem tight(setup);
        CHECK(tight.evaluate(genome).excess > 0.5);
        CHECK(tight.objectives()[0].fitness(tight.evaluate(genome)) < -1);
        setup.limits = {wave, 1.1 * has[1].value, 1.1 * has[2].value, 0.9 * has[3].value};
        CHECK(DesignProblem(setup).sensitivity(genome, "similarity").residuals.tail(3).isZero());
    }
}

TEST_CASE("no finer grid shows a slope, height or curvature beyond the margins") {
    std::mt19937_64 random(33);
    for (int scene = 0; scene < 10; ++scene) {
        const Grid grid{256, 0.84942, false};
        const Genome genome = testing::random_genome(random, 2, 2, 0.84942, 8 * grid.spacing());
        const auto margin = margins(genome, grid, {});
        for (const Index finer : {4, 32}) {
            const Profile profile = sample(genome, refined(grid, finer));
            const Index n = profile.nodes();
            const Eigen::VectorXd slope = (profile.heights.tail(n - 1) - profile.heights.head(n - 1)) / profile.spacing;
            const Eigen::VectorXd curvature = (slope.tail(n - 2) - slope.head(n - 2)) / profile.spacing;
            const double height = profile.heights.maxCoeff() - profile.heights.minCoeff();
            CHECK(slope.cwiseAbs().maxCoeff() <= margin[1].value * (1 + 1e-9));
            CHECK(height <= margin[2].value * (1 + 1e-9));
            CHECK(1 / curvature.cwiseAbs().maxCoeff() >= margin[3].value * (1 - 1e-6));
            if (finer == 32) { // and the margins are at most 2 % above
                CHECK(slope.cwiseAbs().maxCoeff() > 0.98 * margin[1].value);
                CHECK(height > 0.98 * margin[2].value);
                CHECK(1 / curvature.cwiseAbs().maxCoeff() < 1.02 * margin[3].value);
            }
        }
    }
}

TEST_CASE("a genome moved within its bounds has no wave shorter than allowed") {
    const DesignSetup setup = drawn_setup(512);
    const DesignProblem problem(setup);
    for (std::uint64_t start = 0; start < 20; ++start) {
        ga::Stream random(start);
        Genome genome = start % 2 ? shaped_start(setup, random) : drawn_start(setup, random);
        auto values = problem.genes(genome);
        CHECK(problem.bounds(genome).size() + 4 * genome.series.size() >= values.size()); // all phases move
        for (const ga::Variable& variable : problem.bounds(genome))
            values[variable.gene] = random.chance(0.5) ? variable.lower : variable.upper;
        genome = problem.with_genes(genome, values);
        for (const Series& series : genome.series)
            for (const Chromosome& chromosome : series.chromosomes)
                CHECK(wave_length(series, chromosome.n) >= setup.limits.shortest_wave * (1 - 1e-9));
        CHECK(problem.valid(genome));
        genome.series[0].gamma = 1;
        CHECK_FALSE(problem.valid(genome));
    }
}

TEST_CASE("some starts shaped to the drawn target are near it before any search") {
    for (const bool free_amplitude : {false, true}) {
        const DesignSetup setup = drawn_setup(512, !free_amplitude);
        int near = 0;
        for (std::uint64_t key = 0; key < 16; ++key)
            near += similarity(setup, shaped_start(setup, ga::Stream(key))) > 0.9;
        CHECK(near >= 4);
    }
}

TEST_CASE("the amplitude that fits the curve of a genome is the genome's") {
    std::mt19937_64 random(19);
    DesignSetup setup = drawn_setup(64);
    setup.model.loading.steps = 40; // a fit has no fewer
    for (int draw = 0; draw < 24; ++draw) {
        Genome genome = fitted_genome(random, setup);
        setup.targets = {
            target_like(sample(genome, setup.model.grid), setup.model, "itself", Quantity::stiffness, {10})};
        genome.scale = 3;
        CHECK(with_fitting_amplitude(setup, genome).series[0].A == Approx(genome.series[0].A).epsilon(1e-6));
    }
}

TEST_CASE("a design of twice the length and four times the modulus is the same, twice as large") {
    const DesignSetup small{.model = completed({.grid = {64, 0.7}}),
                            .targets = {straight(Quantity::stiffness, 6, 2e-5, 1e-4, 0.4, 0.9)}};
    DesignSetup large{.model = completed({.grid = {64, 1.4}, .body = {.effective_modulus = 4}}),
                      .targets = small.targets};
    large.targets[0].x *= 4;
    large.targets[0].y *= 2;
    const SearchOptions options{.pipeline = "shape 4 | score", .alternatives = 1};
    const Answer one = search(small, options).best, other = search(large, options).best;
    CHECK(other.similarity == Approx(one.similarity).epsilon(1e-9));
    CHECK(other.lowest() == Approx(one.lowest()).epsilon(1e-9));
    CHECK(shortest_wave(other.genome) == Approx(2 * shortest_wave(one.genome)));
    CHECK(large.bounds.lambda_from == 0.25 * large.model.grid.length);
}

TEST_CASE("each of several targets has an objective, whose rows are a part of all rows") {
    DesignSetup setup = drawn_with_area();
    const DesignProblem problem(setup);
    const Genome genome = shaped_start(setup, ga::Stream(3));
    const auto outcome = problem.evaluate(genome);
    const Eigen::VectorXd all = problem.sensitivity(genome, "similarity").residuals;
    REQUIRE(all.size() == 40);
    CHECK(problem.sensitivity(genome, "goal1").residuals == all.head(20));
    CHECK(problem.sensitivity(genome, "goal2").residuals == all.tail(20));
    CHECK(problem.objectives().back().name == "goal2");
    CHECK(problem.objectives().back().fitness(outcome) == 1 - outcome.misfits[1].cwiseAbs().maxCoeff());
}

TEST_CASE("compromises do not dominate each other and keep the limits") {
    DesignSetup setup = drawn_with_area();
    std::vector<Genome> genomes;
    for (std::uint64_t key = 0; key < 30; ++key) genomes.push_back(shaped_start(setup, ga::Stream(key % 25)));
    const auto front = compromises(setup, genomes, 100, 1);
    REQUIRE(front.size() > 1);
    for (std::size_t i = 1; i < front.size(); ++i) {
        CHECK(front[i].similarity[0] > front[i - 1].similarity[0]);
        CHECK(front[i].similarity[1] < front[i - 1].similarity[1]);
    }
    const DesignSetup exact = as_reported(setup);
    for (const Genome& genome : genomes) {
        const auto each = similarities(exact, respond(exact, folded(genome), exact.model));
        CHECK(std::none_of(front.begin(), front.end(),
                           [&](const Compromise& one) { return ga::dominates(each, one.similarity); }));
    }
    const auto few = compromises(setup, genomes, 2, 1);
    CHECK(few.front().similarity == front.front().similarity);
    CHECK(few.back().similarity == front.back().similarity);
    setup.limits.max_height = 1e-9;
    CHECK(compromises(setup, genomes, 100, 1).empty());
}

TEST_CASE("every kind of pipeline keeps bounds and budget, with equal bits on any threads") {
    const DesignSetup setup = rough::testing::drawn_setup(64);
    const DesignProblem problem(setup);
    for (const std::string generation : {"tournament 2 | cross n_points 2 | mutate 0.2 | score | elite 1",
                                         "random | cross sbx 5 | mutate 0.2 | score | crowding",
                                         "share 0.3 | mutate 0.5 | score", "clear 0.2 | mutate 0.5 | score | plus",
                                         "tournament 2 | mutate 0.5 | score | map-elites height skewness cells=4",
                                         "emit 6 slope wavelength | score | map-elites slope wavelength cells=4"}) {
        CAPTURE(generation);
        const auto stage = design_pipeline(setup, "sample 8 | score | repeat 3 { " + generation + " }");
        const auto run_on = [&](int threads, long evaluations) {
            return ga::run(stage, problem, {}, {.seed = 5, .threads = threads, .budget = {.evaluations = evaluations}});
        };
        const auto whole = run_on(1, 1000), again = run_on(2, 1000), part = run_on(2, 20);
        CHECK(whole.stopped.empty());
        CHECK(whole.counters.requested > 20);
        CHECK(part.stopped == "evaluation budget spent");
        CHECK(part.counters.requested_price <= 20);
        CHECK(part.counters.requested_price > 20 - problem.levels()[0].gradient);
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
