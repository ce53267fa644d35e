#include "domain/theory/theory.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/contact/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

void check_against_reference(const ContactOptions& options, double tolerance) {
    for (const auto& scene : scenes::reference_curves()) {
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacement, options);
        REQUIRE(curve.steps.size() == scene.displacement.size());
        CHECK(curve.solver == options.solver);
        for (std::size_t j = 0; j < curve.steps.size(); ++j) {
            INFO(scene.name << ", step " << j);
            const LoadStep& step = curve.steps[j];
            CHECK(std::abs(step.pressure / scene.pressure[j] - 1) < tolerance);
            CHECK(std::abs(step.tangent_stiffness / scene.tangent_stiffness[j] - 1) < tolerance);
            CHECK(step.contact_nodes == scene.contact_nodes[j]);
            CHECK(step.kkt_residual < tolerance);
        }
    }
}

} // namespace

TEST_CASE("pressing to a pressure finds the displacement that gives it", "[contact]") {
    const Solver solver = GENERATE(Solver::nested, Solver::polonsky_keer, Solver::active_set);
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name << ", " << static_cast<int>(solver));
        const std::vector<double> pressures{scene.pressure[1], scene.pressure[8], scene.pressure[19]};
        const ContactCurve curve = solve_contact_at_pressures(scene.profile, scene.body, pressures, {.solver = solver});
        REQUIRE(curve.steps.size() == 3);
        std::size_t k = 0;
        for (const std::size_t j : {1u, 8u, 19u}) {
            const LoadStep& step = curve.steps[k++];
            CHECK(step.displacement == Approx(scene.displacement[j]).epsilon(1e-5));
            CHECK(step.pressure == Approx(scene.pressure[j]).epsilon(1e-5));
            CHECK(step.contact_nodes == scene.contact_nodes[j]);
        }
    }
}

TEST_CASE("every load is met, though a step from first touch leads to full contact", "[contact]") {
    const Body body{Kernel::periodic};
    std::vector<double> pressures; // to contact fractions of 0.01 to 0.9
    for (int j = 0; j < 6; ++j) pressures.push_back(2.5e-4 * std::pow(320, j / 5.0));
    for (const Index nodes : {512, 1024}) // solved by the factor and by conjugate gradients
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            const Profile profile =
                realised({.hurst = 0.8, .longest = 1.0 / 32, .shortest = 1.0 / 256, .rms_slope = 0.1, .is_2d = false},
                         {.nodes = nodes, .length = 1, .periodic = true}, seed);
            const ContactCurve curve = solve_contact_at_pressures(profile, body, pressures);
            INFO(nodes << " nodes, seed " << seed << ", " << name_of(curve.solver));
            for (std::size_t j = 0; j < pressures.size(); ++j)
                CHECK(curve.steps[j].pressure == Approx(pressures[j]).epsilon(2e-6));
        }
    const Profile waves = sampled({16'385, 1, true}, [](double x) {
        const double t = 6.283185307179586 * x;
        return 0.1 * std::cos(t) + 0.02 * std::cos(5 * t + 1) + 0.002 * std::cos(50 * t + 1);
    });
    const double full = full_contact_load(waves, body);
    for (const std::vector<double>& loads : {std::vector{0.02 * full, 0.1 * full}, {0.9999 * full}, {full}})
        CHECK(solve_contact_at_pressures(waves, body, loads).steps.back().pressure ==
              Approx(loads.back()).epsilon(2e-6));
}

TEST_CASE("each solver agrees with an independent implementation within its tolerance", "[contact]") {
    for (const Solver solver : {Solver::nested, Solver::nnls}) check_against_reference({.solver = solver}, 1e-9);
    for (const Solver solver : {Solver::polonsky_keer, Solver::active_set})
        check_against_reference({.solver = solver}, 1e-5);
    // The search in single precision does not limit the result.
    check_against_reference({.solver = Solver::active_set, .tolerance = 1e-10}, 1e-9);
}

TEST_CASE("the oracle in extended precision agrees with the reference curves", "[contact]") {
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name);
        if (scene.profile.nodes() > 256) continue;
        for (const std::size_t j : {0u, 9u, 19u}) {
            const Oracle oracle = consult_oracle(scene.profile, scene.body, {scene.displacement[j]});
            CHECK(oracle.pressure[0] == Approx(scene.pressure[j]).epsilon(1e-12));
            CHECK(oracle.tangent_stiffness[0] == Approx(scene.tangent_stiffness[j]).epsilon(1e-12));
            CHECK(oracle.contact_nodes[0] == scene.contact_nodes[j]);
        }
    }
}
