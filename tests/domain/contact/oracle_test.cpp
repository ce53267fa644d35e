#include "domain/contact/solvers/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

using namespace rough;

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
