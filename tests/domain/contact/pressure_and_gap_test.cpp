#include "domain/contact/interface.hpp"
#include "tests/catch.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

TEST_CASE("pressure and gap exclude each other, and the pressures add up to the load") {
    std::mt19937_64 random(4);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        const bool periodic = kernel == Kernel::periodic;
        const Profile profile =
            sample(testing::random_genome(random, 2, 3, 0.84942, 0.84942 / 40), {.nodes = 400, .periodic = periodic});
        const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
        const Body body{.kernel = kernel, .effective_modulus = 7};
        const auto curve = solve_contact(profile, body, {0.05 * range, 0.3 * range}, {.states = true});
        for (std::size_t j = 0; j < 2; ++j) {
            const Interface at = interface_at(profile, body, curve.steps[j], curve.states[j]);
            CHECK((at.pressure.array() * at.gap.array()).abs().maxCoeff() < 1e-9 * at.pressure.maxCoeff() * range);
            CHECK(at.pressure.minCoeff() >= 0);
            CHECK(at.gap.minCoeff() > -1e-9 * range);
            CHECK(at.pressure.sum() / (periodic ? 400 : 399) == Approx(curve.steps[j].pressure));
            CHECK((at.pressure.array() > 0).count() == curve.steps[j].contact_nodes);
        }
    }
}

TEST_CASE("pressure and gap of a map exclude each other", "[areas]") {
    const Profile map = maps::self_affine(40, 0.8, 2, 0.1);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        const Body body{.kernel = kernel, .effective_modulus = 7};
        const double delta = 0.4 * (map.heights.maxCoeff() - map.heights.mean());
        const auto curve = solve_contact(map, body, {delta}, {.states = true});
        const Interface at = interface_at(map, body, curve.steps[0], curve.states[0]);
        CHECK((at.pressure.array() * at.gap.array()).abs().maxCoeff() < 1e-5 * at.pressure.maxCoeff() * delta);
        CHECK(at.gap.minCoeff() > -1e-5 * delta);
        if (kernel == Kernel::periodic)
            CHECK(at.gap.mean() == Approx(map.heights.maxCoeff() - map.heights.mean() - delta));
        const auto spots = group_sizes(curve.states[0].nodes, {40, 40}, kernel == Kernel::periodic);
        CHECK(at.spots == static_cast<Index>(spots.size()));
        CHECK(at.widest == Approx(static_cast<double>(spots[0]) * map.spacing * map.row_spacing));
    }
}
