#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("the direct solvers agree with an independent oracle on six scenes", "[contact]") {
    const Solver solver = GENERATE(Solver::nested, Solver::nnls);
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name << ", " << static_cast<int>(solver));
        ContactOptions options;
        options.solver = solver;
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacement, options);
        REQUIRE(curve.steps.size() == scene.displacement.size());
        for (std::size_t j = 0; j < curve.steps.size(); ++j) {
            INFO("step " << j);
            const LoadStep& step = curve.steps[j];
            CHECK(std::abs(step.pressure / scene.pressure[j] - 1) < 1e-9);
            CHECK(std::abs(step.tangent_stiffness / scene.tangent_stiffness[j] - 1) < 1e-9);
            CHECK(step.contact_nodes == scene.contact_nodes[j]);
            CHECK(step.kkt_residual < 1e-12);
        }
    }
}
