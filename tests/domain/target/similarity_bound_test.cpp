#include "domain/contact/stepped.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/paper/variants.hpp"
#include "domain/problem/foretold.hpp"
#include "domain/target/similarity.hpp"
#include "domain/target/similarity_bound.hpp"
#include "domain/target/stiffness_limits.hpp"
#include "tests/domain/twenty_targets.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace rough;

namespace {

Model model_on(Kernel kernel, Index nodes) {
    Model model;
    model.grid.nodes = nodes;
    model.grid.wraps = kernel == Kernel::periodic;
    model.body.kernel = kernel;
    model.body.strip_width = model.grid.length / 511;
    model.loading.reach = kernel == Kernel::periodic ? 0.9 : 1;
    return model;
}

} // namespace

TEST_CASE("a curve pressed step by step is the nested solver's, bit for bit, and may be left at any step") {
    std::mt19937_64 random(41);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        const Model model = model_on(kernel, 200);
        const Profile profile = sample(testing::random_genome(random, 1, 1, 0.84942, 0.02), model.grid);
        const auto displacements =
            load_displacements(displacement_range(profile, kernel), model.loading, kernel);
        ContactOptions nested;
        nested.solver = Solver::nested;
        const ContactCurve whole = solve_contact(profile, model.body, displacements, nested);
        SteppedContact stepped(profile, model.body, displacements, {});
        CHECK(stepped.is_own_choice());
        while (!stepped.done()) {
            stepped.press();
            const LoadStep &one = stepped.steps().back(), &other = whole.steps[stepped.steps().size() - 1];
            CHECK(one.displacement == other.displacement);
            CHECK(one.pressure == other.pressure);
            CHECK(one.tangent_stiffness == other.tangent_stiffness);
            CHECK(one.kkt_residual == other.kkt_residual);
            CHECK(one.contact_nodes == other.contact_nodes);
        }
    }
}

TEST_CASE("no curve is more similar than its first steps allow, on every kernel") {
    std::mt19937_64 random(42);
    const auto targets = testing::twenty_targets(RUGOSA_TEST_DATA);
    constexpr double highest = 1.6e-4;
    double gap_late = 0, gap_early = 0;
    int curves = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const auto kernel = static_cast<Kernel>(trial % 3);
        const Model model = model_on(kernel, 120);
        const Genome genome = testing::random_genome(random, 1 + trial % 2, 1, 0.84942, 0.01);
        const Profile profile = sample(genome, model.grid);
        SteppedContact contact(profile, model.body,
                               load_displacements(displacement_range(profile, kernel), model.loading, kernel),
                               {});
        while (!contact.done())
            contact.press();
        const auto& steps = contact.steps();
        const Curve curve = stretched(secant_stiffness(response_of(steps, Solver::nested, 1)),
                                      highest / steps.back().pressure);
        const double stiffest = stiffness_limits(model).most;
        for (std::size_t t = 0; t < targets.size(); t += 3) {
            std::vector<Index> points(20);
            std::iota(points.begin(), points.end(), Index{0});
            if (trial % 4 == 3)
                points.erase(points.begin(), points.begin() + 10);
            // Stiffness of the kernel's own size, or every point would be far away.
            Target target = targets[t];
            target.y *= curve.at(highest) / target.y[19];
            const double similar = similarity(misfit(target, curve)(points));
            SimilarityBound bound(highest, stiffest);
            bound.add(target, points);
            for (std::size_t j = 2; j < steps.size(); ++j) {
                INFO("trial " << trial << ", target " << t << ", steps " << j);
                const double most = bound({steps.begin(), steps.begin() + static_cast<long>(j)}, 20);
                CHECK(most >= similar);
                if (kernel == Kernel::free && (j == 3 || j == 19))
                    (j == 3 ? gap_early : gap_late) += most - similar;
            }
            curves += kernel == Kernel::free;
        }
    }
    CHECK(gap_late < 0.05 * curves); // a bound that tells nothing would pass the rest
    CHECK(gap_late < 0.5 * gap_early);
}

TEST_CASE("a coarse grid foretells what a smooth profile answers, and nothing where it has no say") {
    std::mt19937_64 random(43);
    for (const int count : {20, 21}) {
        Model model = model_on(Kernel::free, 1024);
        model.loading.steps = count;
        const Profile profile = sample(testing::random_genome(random, 1, 1, 0.84942, 0.1), model.grid);
        const auto steps =
            load_displacements(displacement_range(profile, Kernel::free), model.loading, Kernel::free);
        const Curve curve = secant_stiffness(respond(profile, model.body, model.loading));
        const std::vector<double> foretold = foretold_secants(profile, model, steps);
        REQUIRE(foretold.size() == steps.size());
        for (std::size_t j = steps.size() / 4; j < steps.size(); ++j)
            CHECK(foretold[j] == Approx(curve.y[static_cast<Index>(j)]).epsilon(0.1));
        CHECK(foretold_secants({profile.heights.head(255), profile.spacing}, model, steps).empty());
        CHECK(foretold_secants(profile, model_on(Kernel::strip, 1024), steps).empty());
    }
}

TEST_CASE("the foretold bound is the tighter one, and covers at least 95 % of random curves") {
    std::mt19937_64 random(44);
    const Model model = model_on(Kernel::free, 1024);
    const auto targets = testing::twenty_targets(RUGOSA_TEST_DATA);
    const double stiffest = stiffness_limits(model).most;
    std::vector<Index> points(20);
    std::iota(points.begin(), points.end(), Index{0});
    int asked = 0, covered = 0;
    double proven = 0, foretold = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Genome genome = testing::random_genome(random, 1 + trial % 2, 1, 0.84942, model.grid.spacing());
        const Profile profile = sample(genome, model.grid);
        SteppedContact contact(
            profile, model.body,
            load_displacements(displacement_range(profile, Kernel::free), model.loading, Kernel::free), {});
        while (!contact.done())
            contact.press();
        const auto& steps = contact.steps();
        const Curve curve = stretched(secant_stiffness(response_of(steps, Solver::nested, 1)),
                                      1.6e-4 / steps.back().pressure);
        const std::vector<double> secants = foretold_secants(profile, model, contact.displacements());
        for (const Target& target : targets) {
            SimilarityBound bound(1.6e-4, stiffest);
            bound.add(target, points);
            const double similar = similarity(target, curve);
            bool below = false;
            for (std::size_t j = 2; j < steps.size(); j += 3) {
                const std::vector<LoadStep> first(steps.begin(), steps.begin() + static_cast<long>(j));
                const double most = bound(first, 20, secants);
                below = below || most < similar;
                proven += bound(first, 20);
                foretold += most;
            }
            ++asked;
            covered += !below;
        }
    }
    INFO(covered << " of " << asked);
    CHECK(covered >= 0.95 * asked);
    CHECK(foretold < proven - 0.1 * asked);
}

TEST_CASE("the three best of the database and of the pairs are the same when the others are given up") {
    for (const auto& [nodes, outlook] :
         {std::pair<Index, Outlook>(128, Outlook::proven), {1024, Outlook::foretold}}) {
        const Model model = model_on(Kernel::free, nodes);
        const auto genomes = sobol_database({.pairs = 10, .phase_columns = 3, .shortest = 0.84942 / 511});
        using namespace ga;
        const Stage<DesignProblem> database = score() | best(3);
        const Stage<DesignProblem> pairs =
            pair(score("low") | above(0.95, at_least(5)), score("high") | above(0.95, at_least(5)),
                 Vocabulary::unite()) |
            score() | best(3);
        long given_up = 0, asked = 0;
        int threads = 1;
        auto targets = testing::twenty_targets(RUGOSA_TEST_DATA);
        if (nodes > 512) // a fine grid takes its time
            targets.resize(6);
        for (const Target& target : targets) {
            DesignSetup setup = paper_setup(model, target, 1.6e-4, 0.8e-4);
            setup.outlook = outlook;
            const DesignProblem problem(setup);
            for (const auto& pipeline : {database, pairs}) {
                const auto whole = ga::run(pipeline, problem, ga::population(genomes), {.threads = 2});
                const auto screened =
                    ga::run(pipeline, problem, ga::population(genomes), {.threads = 1, .screening = true});
                threads = threads % 4 + 1;
                const auto again = ga::run(pipeline, problem, ga::population(genomes),
                                           {.threads = threads, .screening = true});
                REQUIRE(whole.population.size() == screened.population.size());
                REQUIRE(whole.population.size() == again.population.size());
                for (std::size_t i = 0; i < whole.population.size(); ++i)
                    for (const auto* other : {&screened.population[i], &again.population[i]}) {
                        const auto& one = whole.population[i];
                        CHECK(one.identity == other->identity);
                        CHECK(one.value() == other->value());
                        CHECK(one.genome.scale == other->genome.scale);
                        CHECK(shape_key(one.genome) == shape_key(other->genome));
                    }
                CHECK(screened.counters.given_up == again.counters.given_up);
                given_up += screened.counters.given_up;
                asked += whole.counters.asked;
            }
        }
        CHECK(2 * given_up > asked); // most are
    }
}
