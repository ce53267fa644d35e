#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "tests/domain/contact/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"
#include "tests/domain/derivatives.hpp"

#include <numbers>

using namespace rough;

namespace {

using std::numbers::pi;

double on_rigid_base(double nu, double s) { return static_cast<double>(layer_on_rigid_base(nu, s)); }

Body layered(double thickness, double modulus, double nu, bool rigid, double base_nu = 0.3) {
    Body body{Kernel::periodic, effective_modulus(3, base_nu)};
    body.layering = {{{thickness, modulus, nu}}, rigid, base_nu};
    return body;
}

/// Heights (mm) of three waves with random phases, on a line or a map of lengths 1.
Profile waves(Extent shape, std::uint64_t seed) {
    ga::Stream random(seed);
    Profile profile{Eigen::VectorXd::Zero(shape.nodes()), 1.0 / static_cast<double>(shape.columns)};
    if (shape.rows > 1) profile.rows = shape.rows, profile.row_spacing = 1.0 / static_cast<double>(shape.rows);
    for (const int n : {1, 2, 5}) {
        const double phase = random.uniform(0, 2 * pi), other = random.uniform(0, 2 * pi);
        for (Index k = 0; k < shape.nodes(); ++k) {
            const double x = static_cast<double>(k % shape.columns) / static_cast<double>(shape.columns),
                         y = static_cast<double>(k / shape.columns) / static_cast<double>(shape.rows);
            profile.heights[k] +=
                0.01 / n * (std::cos(2 * pi * n * x + phase) + (shape.rows > 1) * std::cos(2 * pi * n * y + other));
        }
    }
    return profile;
}

} // namespace

TEST_CASE("the compliance of a layer on a rigid base has its closed form") {
    for (const double nu : {-0.5, 0.0, 0.3, 0.45, 0.5})
        for (const double s : {0.01, 0.2, 1.8, 6.0, 150.0}) {
            CAPTURE(nu, s);
            const double expected = s < 100 ? on_rigid_base(nu, s) : 1;
            CHECK(relative_compliance({{{1, 7, nu}}, true}, 7 / (1 - nu * nu), s) == Approx(expected).epsilon(1e-10));
        }
}

TEST_CASE("thick and thin layers have the limits of their half-space and of the base") {
    const double base = effective_modulus(3, 0.2), own = effective_modulus(12, 0.4);
    const auto ratio = [&](double t) { return relative_compliance({{{t, 12, 0.4}}, false, 0.2}, base, 1); };
    CHECK(ratio(30) == Approx(base / own).epsilon(1e-10));
    CHECK(ratio(1e-7) == Approx(1).epsilon(1e-6));
    // Cut into parts, a layer is the same layer.
    CHECK(relative_compliance({{{0.2, 12, 0.4}, {0.5, 12, 0.4}, {0.1, 12, 0.4}}, false, 0.2}, base, 1) ==
          Approx(ratio(0.8)).epsilon(1e-10));
    // A very stiff base is a rigid one.
    CHECK(relative_compliance({{{0.7, 12, 0.4}}, false, 0.2}, base * 1e9, 1) / 1e9 * own / base ==
          Approx(on_rigid_base(0.4, 0.7)).epsilon(1e-7));
    const Layering thin{{{1e-3, 12, 0.4}}, true};
    CHECK(mean_compliance(thin, 1) == Approx(2 / 1e-3 * relative_compliance(thin, own, 1e-3) / own).epsilon(1e-5));
}

TEST_CASE("layers of the body's modulus leave the curve unchanged") {
    for (const Extent shape : {Extent{96, 1}, Extent{16, 24}}) {
        const Profile profile = waves(shape, 3);
        Body plain{Kernel::periodic, effective_modulus(3, 0.3)}, same = plain;
        same.layering = {{{0.05, 3, 0.3}, {0.2, 3, 0.3}}, false, 0.3};
        const auto steps = scenes::load_steps(profile, 5, 0.3);
        const ContactOptions direct{.solver = Solver::nested};
        scenes::check_same(solve_contact(profile, same, steps, direct), solve_contact(profile, plain, steps, direct),
                           1e-10);
    }
}

TEST_CASE("the curve of a layer on a rigid base is the oracle's") {
    const std::vector<double> displacements{0.004, 0.012, 0.03};
    for (const Extent shape : {Extent{64, 1}, Extent{16, 16}})
        for (const double nu : {0.0, 0.3, 0.48})
            for (const double thickness : {0.05, 0.4}) {
                CAPTURE(shape.rows, nu, thickness);
                const Profile profile = waves(shape, 5);
                const Body body = layered(thickness, 7, nu, true);
                const Oracle oracle = consult_oracle(profile, body, displacements);
                const ContactCurve curve = solve_contact(profile, body, displacements);
                for (std::size_t j = 0; j < 3; ++j) {
                    CHECK(curve.steps[j].pressure == Approx(oracle.pressure[j]).epsilon(1e-6));
                    CHECK(curve.steps[j].kkt_residual < 1e-6);
                }
            }
}

TEST_CASE("all solvers agree under layers, by displacement and by load") {
    const Profile profile = waves({128, 1}, 9);
    for (const double nu : {0.1, 0.49})
        for (const Body& body : {layered(0.03, 20, nu, false), layered(0.03, 20, nu, true),
                                 layered(0.01, 200, nu, false)}) { // bends, so that nodes leave contact
            CAPTURE(nu, body.layering.layers[0].modulus, body.layering.rigid_base);
            const auto steps = scenes::load_steps(profile, 6, 0.4);
            const ContactCurve curve = solve_contact(profile, body, steps, {});
            std::vector<double> pressures;
            for (const LoadStep& step : curve.steps) pressures.push_back(step.pressure);
            for (const Solver solver : {Solver::automatic, Solver::nnls, Solver::polonsky_keer, Solver::active_set}) {
                const ContactOptions options{.solver = solver};
                const ContactCurve other = solve_contact(profile, body, steps, options),
                                   loaded = solve_contact_at_pressures(profile, body, pressures, options);
                for (std::size_t j = 0; j < steps.size(); ++j) {
                    CHECK(other.steps[j].pressure == Approx(pressures[j]).epsilon(1e-5));
                    CHECK(loaded.steps[j].displacement == Approx(steps[j]).epsilon(1e-5));
                }
            }
        }
}

TEST_CASE("full contact under layers is that of each wave's compliance") {
    // z = h cos q x is in full contact from P = h/(u/p) on. On a rigid base P then continues to rise by 1/C0.
    const double h = 0.01, nu = 0.3, t = 0.1, modulus = 7;
    const Profile wave = sampled({128, 1, true}, [&](double x) { return h * std::cos(2 * pi * x); });
    const double own = effective_modulus(modulus, nu), q = 2 * pi, full = h * own * q / 2 / on_rigid_base(nu, q * t),
                 c0 = t * (1 + nu) * (1 - 2 * nu) / (modulus * (1 - nu));
    const Body body = layered(t, modulus, nu, true);
    CHECK(full_contact_load(wave, body) == Approx(full).epsilon(1e-10));
    CHECK(full_contact_stiffness(wave, body) == Approx(1 / c0).epsilon(1e-12));
    const double beyond = h + c0 * full * 1.5;
    const LoadStep step = solve_contact(wave, body, {beyond}, {}).steps[0];
    CHECK(step.pressure == Approx(1.5 * full).epsilon(1e-8));
    CHECK(step.tangent_stiffness == Approx(1 / c0).epsilon(1e-8));
    CHECK(step.contact_fraction == 1);
}

TEST_CASE("stiffness under layers has the derivatives of its differences") {
    Genome genome =
        genome_from_json(nlohmann::json::parse(R"({"series":[{"A":0.01,"H":0.8,"gamma":1.5,"lambda":1,"chromosomes":[
            {"n":1,"phases":[0.3]},{"n":2,"phases":[2.1]},{"n":3,"phases":[4.0]}]}]})"),
                         "genome");
    for (const bool rigid : {false, true}) {
        const Model model{{128, 1, true}, layered(0.05, 20, 0.2, rigid), {.steps = 6}};
        const ResponseJacobian jacobian = testing::jacobian_of(genome, model);
        testing::check_derivatives(genome, model, {{jacobian.pressure, [](const Response& response) {
                                                        return Eigen::VectorXd(response.pressure);
                                                    }}});
    }
}

TEST_CASE("impossible layers are refused") {
    const Profile profile = waves({32, 1}, 1);
    const auto refused = [&](const Body& body, const std::string& message) {
        CHECK_THROWS_WITH(solve_contact(profile, body, {0.001}, {}), Catch::Contains(message));
    };
    refused(layered(0, 7, 0.3, true), "thickness");
    refused(layered(0.1, -7, 0.3, true), "modulus");
    refused(layered(0.1, 7, 0.6, true), "Poisson");
    Body free = layered(0.1, 7, 0.3, false);
    free.kernel = Kernel::free;
    refused(free, "periodic");
    Body bare{Kernel::periodic};
    bare.layering.rigid_base = true;
    refused(bare, "--layer");
}
