#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("pressing to a pressure finds the displacement that gives it", "[contact]") {
    const Solver solver = GENERATE(Solver::nested, Solver::polonsky_keer, Solver::active_set);
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name << ", " << static_cast<int>(solver));
        ContactOptions options;
        options.solver = solver;
        const std::vector<double> pressures{scene.pressure[1], scene.pressure[8], scene.pressure[19]};
        const ContactCurve curve = solve_contact_at_pressures(scene.profile, scene.body, pressures, options);
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

TEST_CASE("a periodic profile bears no more than full contact under load control", "[contact]") {
    for (const auto& scene : scenes::reference_curves())
        if (scene.body.kernel == Kernel::periodic)
            CHECK_THROWS_WITH(solve_contact_at_pressures(scene.profile, scene.body, {1e6}),
                              Catch::Contains("at most that of full contact"));
}
