#include "domain/contact/kernel.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/contact/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

using scenes::Scene;

/// The highest node pressure without a hardness, MPa.
double highest_pressure(const Scene& scene) {
    return solve_contact(scene.profile, scene.body, scene.displacements, {.states = true})
        .states.back()
        .pressure.maxCoeff();
}

} // namespace

TEST_CASE("pressures held at a hardness are the oracle's, on every kernel", "[contact]") {
    std::mt19937 random(41);
    Index held = 0, measured = 0;
    for (int trial = 0; trial < 24; ++trial) {
        Scene scene = scenes::random_scene(random, trial, 16, 24, 4);
        scene.body.hardness =
            highest_pressure(scene) * std::array{0.05, 0.3, 0.6, 0.9}[static_cast<std::size_t>(trial % 4)];
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacements, {.states = true});
        const Oracle oracle = consult_oracle(scene.profile, scene.body, scene.displacements);
        for (std::size_t j = 0; j < curve.steps.size(); ++j) {
            const LoadStep& step = curve.steps[j];
            INFO("trial " << trial << ", step " << j << ", held " << step.held_nodes);
            CHECK(step.pressure == Approx(oracle.pressure[j]).epsilon(1e-9));
            CHECK(step.tangent_stiffness ==
                  Approx(oracle.tangent_stiffness[j]).epsilon(1e-9).margin(1e-9 * curve.steps[0].tangent_stiffness));
            CHECK(step.contact_nodes == oracle.contact_nodes[j]);
            CHECK(step.held_nodes == oracle.held_nodes[j]);
            CHECK(step.kkt_residual < 1e-10);
            for (std::size_t k = 0; k < curve.states[j].nodes.size(); ++k) {
                const auto node = static_cast<std::size_t>(curve.states[j].nodes[k]);
                const double p = curve.states[j].pressure[static_cast<Index>(k)];
                CHECK(std::abs(p - oracle.node_pressure[j][node]) <= 1e-9 * scene.body.hardness);
                CHECK(p <= scene.body.hardness * (1 + 1e-15));
                if (p >= scene.body.hardness * (1 - 1e-15)) CHECK(curve.states[j].tangent[static_cast<Index>(k)] == 0);
            }
            held += step.held_nodes, measured += step.kkt_residual > 0;
        }
    }
    CHECK(held > 100);
    CHECK(measured > 80); // 96 residuals less those of rounding
}

TEST_CASE("a hardness changes the curve only if a node reaches it", "[contact]") {
    std::mt19937 random(42);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Scene scene = scenes::random_scene(random, static_cast<int>(kernel), 1500, 0, 4);
        const double highest = highest_pressure(scene);
        const ContactCurve elastic = solve_contact(scene.profile, scene.body, scene.displacements);
        scene.body.hardness = 1.01 * highest;
        const ContactCurve hard = solve_contact(scene.profile, scene.body, scene.displacements);
        scenes::check_same(hard, elastic, 2e-6);
        for (const LoadStep& step : hard.steps) CHECK(step.held_nodes == 0);
        scene.body.hardness = 0.1 * highest;
        const ContactCurve soft = solve_contact(scene.profile, scene.body, scene.displacements);
        for (std::size_t j = 0; j < soft.steps.size(); ++j) CHECK(soft.steps[j].pressure < elastic.steps[j].pressure);
        CHECK(soft.steps.back().held_nodes > 0);
        // The curve is the same under load control.
        const double between = 0.5 * (soft.steps[1].pressure + soft.steps[2].pressure);
        const ContactCurve loaded = solve_contact_at_pressures(scene.profile, scene.body, {between});
        CHECK(loaded.steps[0].pressure == Approx(between).epsilon(1e-9));
        CHECK(loaded.steps[0].displacement > soft.steps[1].displacement);
        CHECK(loaded.steps[0].displacement < soft.steps[2].displacement);
        CHECK_THROWS_WITH(solve_contact_at_pressures(scene.profile, scene.body, {1.1 * scene.body.hardness}),
                          Catch::Contains("hardness"));
    }
}

TEST_CASE("every direct solver's tangent is the derivative of its pressures", "[contact]") {
    std::mt19937 random(43);
    for (const Solver solver : {Solver::nested, Solver::nnls})
        for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
            const Scene scene = scenes::random_scene(random, static_cast<int>(kernel), 40, 0, 4);
            const double d = scene.displacements[2], step = 1e-7 * d;
            const auto at = [&](double displacement) {
                const ContactCurve curve =
                    solve_contact(scene.profile, scene.body, {displacement}, {.solver = solver, .states = true});
                Eigen::VectorXd pressure = Eigen::VectorXd::Zero(40), tangent = pressure;
                const ContactState& state = curve.states[0];
                pressure(state.nodes) = state.pressure;
                tangent(state.nodes) = state.tangent;
                return std::pair(pressure, tangent);
            };
            const Eigen::VectorXd differences = (at(d + step).first - at(d - step).first) / (2 * step);
            const Eigen::VectorXd tangent = at(d).second;
            CHECK((differences - tangent).norm() <= 1e-6 * tangent.norm());
        }
}

TEST_CASE("a periodic profile carries every load below that of all nodes at the hardness", "[contact]") {
    // Heights in nm, spacing 1 m. When nodes sink in, the elastic approach of full contact does not limit the
    // load.
    Profile profile{(Eigen::VectorXd(8) << 3.488361934, 0.5285306326, 1.211154584, 2.732274234, 9.836153812,
                     -0.6971507176, 7.815714301, -0.4819841083)
                            .finished() *
                        1e-6,
                    1000};
    const Body body{.kernel = Kernel::periodic, .effective_modulus = 1000, .hardness = 3.2609185146591581e-06};
    for (const double share : {0.05, 0.089462972, 0.33, 0.81245457, 0.99}) {
        INFO("share " << share);
        const double pressure = share * body.hardness;
        const LoadStep step = solve_contact_at_pressures(profile, body, {pressure}).steps[0];
        CHECK(step.pressure == Approx(pressure).epsilon(1e-9));
        CHECK(step.kkt_residual < 1e-9);
        CHECK(consult_oracle(profile, body, {step.displacement}).pressure[0] == Approx(pressure).epsilon(1e-6));
    }
}

TEST_CASE("a map with steps carries a load below its hardness", "[contact]") {
    std::mt19937 random(43);
    const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    for (int trial = 0; trial < 12; ++trial) {
        const Index columns = 48, rows = trial % 3 == 0 ? 8 : 32;
        Profile map{Eigen::VectorXd(columns * rows), 0.01, rows, 0.01};
        for (double& height : map.heights) height = 0.01 * std::round(4 * uniform(-1, 1)) / 4 + 1e-5 * uniform(-1, 1);
        Body body{.kernel = trial % 2 ? Kernel::periodic : Kernel::free, .effective_modulus = 1};
        const double pressure = std::pow(10, uniform(-5, -2));
        body.hardness = pressure * std::pow(10, uniform(0.02, 2));
        INFO("trial " << trial << ", pressure " << pressure << ", hardness " << body.hardness);
        const LoadStep step = solve_contact_at_pressures(map, body, {pressure}).steps[0];
        CHECK(step.pressure == Approx(pressure).epsilon(1e-8));
        CHECK(step.kkt_residual < 1e-9);
    }
}

TEST_CASE("beyond the approach of full contact nodes sink in at the hardness", "[contact]") {
    std::mt19937 random(44);
    for (int trial = 0; trial < 5; ++trial) {
        Scene scene = scenes::random_scene(random, trial, 16, 24, 1);
        scene.body.kernel = Kernel::periodic;
        if (trial == 4)
            scene.profile = maps::map_of({16, 12}, 1.0 / 16, 1.0 / 12, [](double x, double y) {
                return std::cos(2 * std::numbers::pi * x) * std::cos(2 * std::numbers::pi * y);
            });
        const double full = scene.profile.heights.maxCoeff() - scene.profile.heights.mean();
        scene.displacements = {0.99 * full};
        scene.body.hardness = 2 * highest_pressure(scene);
        const double beyond = std::array{1e-3, 0.01, 0.1, 1.0, 1e-4}[static_cast<std::size_t>(trial)];
        const std::vector displacements{full * (1 + beyond)};
        const LoadStep step = solve_contact(scene.profile, scene.body, displacements).steps[0];
        INFO("trial " << trial);
        CHECK(step.pressure ==
              Approx(consult_oracle(scene.profile, scene.body, displacements).pressure[0]).epsilon(1e-9));
        CHECK(step.contact_nodes == scene.profile.nodes());
        CHECK(step.held_nodes > 0);
        CHECK(step.kkt_residual < 1e-9);
    }
}

TEST_CASE("full contact carries a range of loads until a node reaches the hardness", "[contact]") {
    const Index n = 64;
    const double amplitude = 0.01, full = std::numbers::pi * amplitude; // Westergaard's load, E* = 1, L = 1
    const Profile profile =
        sampled({n, 1, true}, [&](double x) { return amplitude * std::cos(2 * std::numbers::pi * x); });
    const Body body{.kernel = Kernel::periodic, .hardness = 3 * full};
    const ContactCurve curve =
        solve_contact_at_pressures(profile, body, {0.5 * full, 1.2 * full, 1.9 * full, 2.5 * full}, {.states = true});
    for (const std::size_t j : {1u, 2u}) {
        CHECK(curve.steps[j].displacement == Approx(amplitude).epsilon(1e-12));
        CHECK(curve.steps[j].contact_nodes == n);
        CHECK(curve.steps[j].held_nodes == 0);
        CHECK(curve.states[j].pressure.maxCoeff() ==
              Approx(curve.steps[j].pressure + full).epsilon(1e-9)); // P (1 + cos)
    }
    CHECK(curve.steps[0].contact_nodes < n);
    CHECK(curve.steps[3].held_nodes > 0);
    CHECK(curve.steps[3].displacement > amplitude);
}
