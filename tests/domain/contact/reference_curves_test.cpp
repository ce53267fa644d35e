#include "domain/contact/solvers/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

void check_against_oracle(Solver solver, double tolerance, ContactOptions options = {}) {
    options.solver = solver;
    for (const auto& scene : scenes::reference_curves()) {
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacement, options);
        REQUIRE(curve.steps.size() == scene.displacement.size());
        CHECK(curve.solver == solver);
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

TEST_CASE("the direct solvers agree with an independent oracle on six scenes", "[contact]") {
    check_against_oracle(GENERATE(Solver::nested, Solver::nnls), 1e-9);
}

TEST_CASE("the iterative solvers agree with an independent oracle to ten times their tolerance",
          "[contact]") {
    check_against_oracle(GENERATE(Solver::polonsky_keer, Solver::active_set),
                         10 * ContactOptions().tolerance);
}

TEST_CASE("the active set, whose search is in single precision, still answers far beyond it", "[contact]") {
    ContactOptions options;
    options.tolerance = 1e-10;
    check_against_oracle(Solver::active_set, 10 * options.tolerance, options);
}

TEST_CASE("the oracle in extended precision agrees with the reference curves", "[contact]") {
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name);
        if (scene.profile.nodes() > 256)
            continue;
        const std::vector<double> some{scene.displacement[0], scene.displacement[9], scene.displacement[19]};
        const Oracle oracle = consult_oracle(scene.profile, scene.body, some);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t j = std::array{0u, 9u, 19u}[k];
            CHECK(oracle.pressure[k] == Approx(scene.pressure[j]).epsilon(1e-12));
            CHECK(oracle.tangent_stiffness[k] == Approx(scene.tangent_stiffness[j]).epsilon(1e-12));
            CHECK(oracle.contact_nodes[k] == scene.contact_nodes[j]);
        }
    }
}
