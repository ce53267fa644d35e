#include "tests/domain/contact/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

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

TEST_CASE("each solver agrees with an independent implementation within its tolerance", "[contact]") {
    for (const Solver solver : {Solver::nested, Solver::nnls})
        check_against_reference({.solver = solver}, 1e-9);
    for (const Solver solver : {Solver::polonsky_keer, Solver::active_set})
        check_against_reference({.solver = solver}, 1e-5);
    // The search in single precision does not limit the result.
    check_against_reference({.solver = Solver::active_set, .tolerance = 1e-10}, 1e-9);
}

TEST_CASE("the oracle in extended precision agrees with the reference curves", "[contact]") {
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name);
        if (scene.profile.nodes() > 256)
            continue;
        for (const std::size_t j : {0u, 9u, 19u}) {
            const Oracle oracle = consult_oracle(scene.profile, scene.body, {scene.displacement[j]});
            CHECK(oracle.pressure[0] == Approx(scene.pressure[j]).epsilon(1e-12));
            CHECK(oracle.tangent_stiffness[0] == Approx(scene.tangent_stiffness[j]).epsilon(1e-12));
            CHECK(oracle.contact_nodes[0] == scene.contact_nodes[j]);
        }
    }
}
