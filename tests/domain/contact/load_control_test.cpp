#include "domain/theory/random_surface.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

#include <cmath>

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

TEST_CASE("every load is met from the lightest on, though a step from first touch leads to full contact",
          "[contact]") {
    Body body;
    body.kernel = Kernel::periodic;
    std::vector<double> pressures; // to contact fractions of 0.01 to 0.9
    for (int j = 0; j < 6; ++j)
        pressures.push_back(2.5e-4 * std::pow(320, j / 5.0));
    for (const Index nodes : {512, 1024}) // by the factor, by conjugate gradients
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            const Profile profile = realised({.hurst = 0.8,
                                              .longest = 1.0 / 32,
                                              .shortest = 1.0 / 256,
                                              .rms_slope = 0.1,
                                              .is_area = false},
                                             {.nodes = nodes, .length = 1, .wraps = true}, seed);
            const ContactCurve curve = solve_contact_at_pressures(profile, body, pressures);
            INFO(nodes << " nodes, seed " << seed << ", " << curve.choice);
            for (std::size_t j = 0; j < pressures.size(); ++j)
                CHECK(curve.steps[j].pressure == Approx(pressures[j]).epsilon(2e-6));
        }
}

TEST_CASE("a periodic profile bears no more than full contact under load control", "[contact]") {
    for (const auto& scene : scenes::reference_curves())
        if (scene.body.kernel == Kernel::periodic)
            CHECK_THROWS_WITH(solve_contact_at_pressures(scene.profile, scene.body, {1e6}),
                              Catch::Contains("at most that of full contact"));
}

TEST_CASE("a solver's tolerance is between 1e-10 and 0.01, whatever is asked for and of whichever solver",
          "[contact]") {
    const Profile profile{Eigen::Vector4d(0, 1, 0.5, 0), 0.1};
    for (const double tolerance : {0.0, 9e-11, 0.011, -1.0, std::nan("")}) {
        ContactOptions options;
        options.tolerance = tolerance;
        CHECK_THROWS_WITH(solve_contact(profile, Body{}, {0.1}, options), Catch::Contains("tolerance"));
        CHECK_THROWS_WITH(solve_contact_at_pressures(profile, Body{}, {0.1}, options),
                          Catch::Contains("tolerance"));
    }
    for (const double tolerance : {1e-10, 0.01}) {
        ContactOptions options;
        options.tolerance = tolerance;
        CHECK(solve_contact(profile, Body{}, {0.1}, options).steps[0].pressure > 0);
    }
}

TEST_CASE("a periodic map settles at half contact under load and displacement control", "[contact]") {
    const Body body{Kernel::periodic};
    ContactOptions active_set, polonsky_keer;
    active_set.solver = Solver::active_set;
    polonsky_keer.solver = Solver::polonsky_keer;
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        INFO("seed " << seed);
        const Profile map = maps::self_affine(192, 0.8, seed, 0.1);
        const std::vector<double> load{0.027 + 0.002 * seed}; // Persson: erf(sqrt(2) P/(E* slope))
        const LoadStep loaded = solve_contact_at_pressures(map, body, load, active_set).steps[0];
        const LoadStep pressed = solve_contact(map, body, {loaded.displacement}, active_set).steps[0];
        const LoadStep reference = solve_contact_at_pressures(map, body, load, polonsky_keer).steps[0];
        CHECK(loaded.contact_fraction > 0.3);
        CHECK(loaded.contact_fraction == Approx(reference.contact_fraction).epsilon(1e-3));
        CHECK(loaded.displacement == Approx(reference.displacement).epsilon(1e-5));
        CHECK(pressed.pressure == Approx(reference.pressure).epsilon(1e-5));
    }
}

TEST_CASE("no solver under load control takes over three times its neighbours' products", "[contact]") {
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        std::vector<long> products;
        for (const double contact : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95})
            for (const unsigned seed : {1u, 2u}) {
                const Profile map = maps::self_affine(128, 0.8, seed, 0.1);
                ContactOptions options;
                options.solver = Solver::active_set;
                const double load = 0.1 * 0.5 * contact / std::sqrt(1.01 - contact * contact);
                products.push_back(solve_contact_at_pressures(map, Body{kernel}, {load}, options).iterations);
            }
        for (std::size_t k = 2; k < products.size(); ++k)
            CHECK(products[k] <= 3 * products[k - 2]);
    }
}

TEST_CASE("the factor meets a load as Newton's method on its displacements does", "[contact]") {
    ContactOptions nested, nnls;
    nested.solver = Solver::nested;
    nnls.solver = Solver::nnls;
    const std::vector<double> loads{1e-4, 1e-3, 3e-3};
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        const Profile map = maps::self_affine(32, 0.8, 3, 0.1);
        const ContactCurve direct = solve_contact_at_pressures(map, Body{kernel}, loads, nested);
        const ContactCurve newton = solve_contact_at_pressures(map, Body{kernel}, loads, nnls);
        for (std::size_t j = 0; j < loads.size(); ++j) {
            CHECK(direct.steps[j].pressure == Approx(loads[j]).epsilon(1e-12));
            CHECK(direct.steps[j].displacement == Approx(newton.steps[j].displacement).epsilon(1e-9));
            CHECK(direct.steps[j].contact_nodes == newton.steps[j].contact_nodes);
            CHECK(direct.steps[j].kkt_residual < 1e-9);
        }
    }
}
