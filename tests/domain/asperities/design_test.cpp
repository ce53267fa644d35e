#include "domain/asperities/design.hpp"
#include "domain/errors.hpp"
#include "domain/problem/response.hpp"
#include "tests/catch.hpp"

using namespace rough;

namespace {

/// The set-up of n x n caps as they are made of PDMS.
CapSetup made_of_pdms(Index n, CapModel model = CapModel::interacting) {
    return {.array = {n, n, 1.5}, .effective_modulus = 1.36, .model = model, .nodes = 64 * 64};
}

/// The law of a force per area (mm^2 against N) as a target.
template <class Law>
Target target_of(const CapSetup& setup, double from, double to, Law law) {
    const double nominal = setup.array.nominal_area();
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(8, from, to) / nominal;
    return {Quantity::area_at_pressure, "", x, x.unaryExpr([&](double p) { return law(p * nominal) / nominal; })};
}

CapGenome random_genome(CapSetup setup, std::uint64_t seed) {
    if (setup.targets.empty()) // which do not affect the genome
        setup.targets = {target_of(setup, 0.01, 0.1, [](double) { return 1.0; })};
    ga::Stream random(seed);
    return CapProblem(setup).sample(random);
}

/// The curve of random caps as a target.
Target hidden_law(const CapSetup& setup, std::uint64_t seed) {
    Target target = target_of(setup, 0.01, 0.1, [](double) { return 1.0; });
    target.x *= static_cast<double>(setup.array.caps()) / 16;
    target.y = curve_of(setup, target, random_genome(setup, seed), setup.model).values;
    return target;
}

bool is_on_steps(const CapSetup& setup, const CapGenome& genome) {
    return std::ranges::all_of(genome,
                               [&](double height) { return std::abs(height - setup.heights.nearest(height)) < 1e-12; });
}

} // namespace

TEST_CASE("derivatives of every target of caps equal differences") {
    for (const CapModel model : {CapModel::independent, CapModel::interacting})
        for (const Quantity quantity : {Quantity::stiffness, Quantity::area_at_pressure, Quantity::area_at_displacement,
                                        Quantity::load_at_displacement, Quantity::interface_stiffness}) {
            CapSetup setup = made_of_pdms(3, model);
            setup.radii = {0.3, 0.53, 0};
            setup.targets = {hidden_law(setup, 5)};
            Target& target = setup.targets[0];
            target.quantity = quantity;
            if (!against_pressure(quantity)) target.x = Eigen::VectorXd::LinSpaced(8, 0.02, 0.1);
            target.y.setConstant(0.1);
            const CapProblem problem(setup);
            CapGenome genome = random_genome(setup, 6);
            for (std::size_t g = 0; g < genome.size(); ++g) // no cap touches just at a point or with another
                genome[g] += 1e-5 * (13.7 + static_cast<double>(g));
            const ga::Sensitivity at = problem.sensitivity(genome, "goal1");
            for (std::size_t g = 0; g < genome.size(); ++g) {
                CapGenome up = genome, down = genome;
                up[g] += 1e-7, down[g] -= 1e-7;
                const Eigen::VectorXd difference = (problem.evaluate(up)[0] - problem.evaluate(down)[0]) / 2e-7;
                INFO(name_of(quantity) << ", gene " << g);
                CHECK((difference - at.jacobian.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() <=
                      1e-5 * at.jacobian.cwiseAbs().maxCoeff());
            }
        }
}

TEST_CASE("a cap under an approach has the load and area of Hertz's contact") {
    const CapSetup setup = made_of_pdms(1);
    const Eigen::VectorXd depth = Eigen::VectorXd::LinSpaced(8, 0.01, 0.1),
                          area = std::numbers::pi * 0.526 / 2.25 * depth,
                          load = 4 * 1.36 / 3 * std::sqrt(0.526) / 2.25 * depth.array().pow(1.5);
    for (const Target& hertz :
         {Target{Quantity::load_at_displacement, "", depth, load}, {Quantity::area_at_displacement, "", depth, area}})
        CHECK(curve_of(setup, hertz, {0.05}, setup.model).values.isApprox(hertz.y, 1e-9));
}

TEST_CASE("a search finds the law of hidden caps on whole steps, with any threads") {
    CapSetup setup = made_of_pdms(4);
    setup.targets = {hidden_law(setup, 11)};
    setup.nodes = 256 * 256;
    const CapSearch found = search(setup, {.threads = 1});
    CHECK(found.best.similarity >= 0.985);
    CHECK(is_on_steps(setup, found.best.genome));
    CHECK(found.best.verification.area_error < 0.02);
    CHECK(found.best.lowest() <= found.best.similarity);
    CHECK(search(setup, {.threads = 2}).best.genome == found.best.genome);
}

TEST_CASE("an answer of a pipeline without round is on the steps") {
    CapSetup setup = made_of_pdms(2);
    setup.targets = {hidden_law(setup, 3)};
    for (const char* pipeline : {"sample 4 | score | refine lm 5", "genetic"})
        CHECK(is_on_steps(setup, search(setup, {.pipeline = pipeline, .evaluations = 200}).best.genome));
}

TEST_CASE("exchanged caps change the law by their interaction only, and do not add an alternative") {
    for (const CapModel model : {CapModel::independent, CapModel::interacting}) {
        CapSetup setup = made_of_pdms(3, model);
        setup.radii = {0.3, 0.53, 0};
        setup.targets = {hidden_law(setup, 3)};
        const auto found = [&](const char* how) { return search(setup, {.pipeline = how}); };
        const double moved =
            found("sample 1 | mutate 1 exchange | score").best.similarity - found("sample 1 | score").best.similarity;
        CHECK((std::abs(moved) < 1e-12) == (model == CapModel::independent));
        CHECK(found("sample 1 | score | mutate 1 exchange | score").alternatives.size() == 1);
    }
}

TEST_CASE("round keeps a steep law better than the nearest steps do") {
    CapSetup setup = made_of_pdms(8, CapModel::independent);
    setup.targets = {target_of(setup, 0.1, 0.2, [](double force) { return 1.2 * std::pow(force / 0.2, 1.35); })};
    const std::string relaxed = "sample 200 | score | best 8 | refine lm 60 | best 1";
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const auto similarity = [&](const std::string& pipeline) {
            return search(setup, {.pipeline = pipeline, .seed = seed, .threads = 1}).best.similarity;
        };
        const double nearest = similarity(relaxed), rounded = similarity(relaxed + " | round 200 | score");
        CAPTURE(seed, nearest, rounded);
        CHECK(rounded > nearest);
        CHECK(similarity(relaxed + " | round 200 | score | round 200 | score") == rounded); // at rest
    }
}

TEST_CASE("corrected targets give interacting caps the law that independent caps miss") {
    CapSetup setup = made_of_pdms(8);
    setup.targets = {target_of(setup, 0.1, 0.6, [](double force) { return 1.3 * std::pow(force / 0.2, 0.8); })};
    const CapGenome genome = random_genome(setup, 4);
    const auto misfits = [&](const CapSetup& of) { return CapProblem(of).evaluate(genome)[0]; };
    CHECK((misfits(setup) - misfits(with_independent_caps(setup))).cwiseAbs().maxCoeff() > 1e-3);
    CHECK((misfits(setup) - misfits(with_independent_caps(setup, &genome))).cwiseAbs().maxCoeff() < 1e-12);

    const auto error = [&](const std::string& pipeline) {
        return 1 - search(setup, {.pipeline = pipeline, .threads = 1}).best.similarity;
    };
    const std::string separate =
        "independent { sample 100 | score | best 4 | refine lm 60 sharpen=20 | best 1 | round 50 } | score";
    CHECK(error(separate + " | corrected { score | refine lm 30 sharpen=5 | round 50 } | score") <
          0.5 * error(separate));
    const auto evaluations = [&](const std::string& stage) {
        return search(setup, {.pipeline = "sample 4 | " + stage + " { score } | score"}).counters.evaluations;
    };
    CHECK(evaluations("corrected") == evaluations("independent") + 2); // both models of the first caps
}

TEST_CASE("a thousand caps follow a line by boundary elements after few evaluations", "[long]") {
    CapSetup setup = made_of_pdms(8);
    setup.array = {40, 25, 1.5};
    setup.radii = {0.1, 0.53, 0.01};
    setup.nodes = 1024 * 1024;
    setup.targets = {target_of(setup, 1.673, 14.91, [](double force) { return 3.1069 * force; })};
    const std::string separate = "independent { sample 60 | score | best 4 | refine lm 30 | best 1 | refine "
                                 "lm 40 sharpen=10 } | ",
                      together = "repeat 2 { corrected { score | refine lm 20 sharpen=5 | round 10 } | score }";
    const CapSearch found = search(setup, {.pipeline = separate + together});
    CHECK(found.best.lowest() >= 0.985);
    CHECK(found.counters.evaluations + found.counters.gradients <= 2500);
}

TEST_CASE("the law of caps is never reported as out of their reach") {
    for (const CapModel model : {CapModel::independent, CapModel::interacting})
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            CapSetup setup = made_of_pdms(4, model);
            if (seed % 2 == 0) setup.radii = {0.2, 0.53, 0};
            setup.targets = {hidden_law(setup, seed)};
            CHECK(out_of_reach(setup).empty());
        }
}

TEST_CASE("a law below the area of one cap is out of reach, with the best similarity") {
    CapSetup setup = made_of_pdms(8);
    setup.targets = {target_of(setup, 0.01, 0.2, [](double force) { return 5.1788654 * force; })};
    const auto found = out_of_reach(setup);
    REQUIRE(found.size() == 1);
    // One cap has 1.5 times the area of the first point.
    const double one = hertz_area(0.01, 0.526, 1.36);
    CHECK(found[0].bound == Approx(2 - one / 0.051788654).epsilon(1e-6));
    CHECK(search(setup, {.pipeline = "pass", .evaluations = 300}).best.similarity <= found[0].bound);
}

TEST_CASE("larger errors of a law allow larger errors of heights, which 95 % of other draws confirm") {
    CapSetup setup = made_of_pdms(4, CapModel::independent);
    setup.targets = {hidden_law(setup, 2)};
    const CapGenome genome = random_genome(setup, 2);
    const CapProblem problem(setup);
    ga::Stream random(7);
    double before = 0;
    for (const auto& [error, rms] : height_tolerance(setup, genome, 1, 400, 1)) {
        INFO(error << ", " << rms << " mm");
        CHECK(rms > before);
        before = rms;
        int kept = 0;
        for (int draw = 0; draw < 400; ++draw) {
            CapGenome made = genome;
            for (double& height : made) height += rms * random.normal();
            kept += 1 - min_similarity(problem.evaluate(made)) <= error;
        }
        CHECK(std::abs(kept - 380) <= 26); // both shares are off by sqrt(0.95 0.05/400); four times both
    }
}
