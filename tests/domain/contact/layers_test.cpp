#include "domain/contact/full_contact.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/layers.hpp"
#include "domain/errors.hpp"
#include "ga/base/random.hpp"
#include "tests/domain/contact/scenes.hpp"
#include "tests/domain/derivatives.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace rough;

namespace {

constexpr double pi = std::numbers::pi;

/// u/p over 2/(E* q) of one layer on a rigid base in closed form, s = q t.
double on_rigid_base(double nu, double s) {
    return ((3 - 4 * nu) * std::sinh(2 * s) - 2 * s) /
           ((3 - 4 * nu) * std::cosh(2 * s) + 2 * s * s + 5 - 12 * nu + 8 * nu * nu);
}

Body layered(double thickness, double modulus, double nu, bool rigid, double base_nu = 0.3) {
    Body body{Kernel::periodic, effective_modulus(3, base_nu)};
    body.layering = {{{thickness, modulus, nu}}, rigid, base_nu};
    return body;
}

/// Heights (mm) of three waves with random phases, on a line or a map of lengths 1.
Profile waves(Extent shape, std::uint64_t seed) {
    ga::Stream random(seed);
    Profile profile{Eigen::VectorXd::Zero(shape.nodes()), 1.0 / static_cast<double>(shape.columns)};
    if (shape.rows > 1)
        profile.rows = shape.rows, profile.row_spacing = 1.0 / static_cast<double>(shape.rows);
    for (const int n : {1, 2, 5}) {
        const double phase = random.uniform(0, 2 * pi), other = random.uniform(0, 2 * pi);
        for (Index k = 0; k < shape.nodes(); ++k) {
            const double x = static_cast<double>(k % shape.columns) / static_cast<double>(shape.columns),
                         y = static_cast<double>(k / shape.columns) / static_cast<double>(shape.rows);
            profile.heights[k] +=
                0.01 / n *
                (std::cos(2 * pi * n * x + phase) + (shape.rows > 1) * std::cos(2 * pi * n * y + other));
        }
    }
    return profile;
}

/// Mean pressure by projected Gauss-Seidel on the dense matrix of a layer on a rigid base, whose entries are
/// sums of cosines: nothing is shared with the solvers.
double dense_pressure(const Profile& profile, const Body& body, double displacement) {
    const Layer layer = body.layering.layers[0];
    const double own = effective_modulus(layer.modulus, layer.poissons_ratio);
    const Index n = profile.nodes(), columns = profile.shape().columns, rows = profile.shape().rows;
    Eigen::VectorXd h = Eigen::VectorXd::Zero(n); // by the offset along x and y
    for (Index l = 0; l < rows; ++l)
        for (Index k = 0; k < columns; ++k) {
            const auto wave = [](Index i, Index count) {
                return static_cast<double>(std::min(i, count - i));
            };
            const double q = 2 * pi * std::hypot(wave(k, columns), wave(l, rows)); // both lengths are 1
            const double nu = layer.poissons_ratio;
            const double compliance =
                q == 0 ? layer.thickness * (1 + nu) * (1 - 2 * nu) / (layer.modulus * (1 - nu))
                       : 2 / (own * q) * on_rigid_base(nu, q * layer.thickness);
            for (Index j = 0; j < n; ++j)
                h[j] +=
                    compliance / static_cast<double>(n) *
                    std::cos(2 * pi * static_cast<double>(k * (j % columns)) / static_cast<double>(columns) +
                             2 * pi * static_cast<double>(l * (j / columns)) / static_cast<double>(rows));
        }
    const Eigen::VectorXd wanted =
        displacement - (profile.heights.maxCoeff() - profile.heights.array()).matrix().array();
    Eigen::MatrixXd H(n, n);
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            H(i, j) = h[std::abs(i / columns - j / columns) * columns + std::abs(i % columns - j % columns)];
    Eigen::VectorXd p = Eigen::VectorXd::Zero(n);
    for (double change = 1; change > 1e-14 * p.maxCoeff();) {
        change = 0;
        for (Index i = 0; i < n; ++i) {
            const double next = std::max(0.0, p[i] + (wanted[i] - H.row(i).dot(p)) / H(i, i));
            change = std::max(change, std::abs(next - p[i]));
            p[i] = next;
        }
    }
    return p.mean();
}

} // namespace

TEST_CASE("the compliance of a layer on a rigid base has its closed form") {
    for (const double nu : {-0.5, 0.0, 0.3, 0.45, 0.5})
        for (const double s : {0.01, 0.2, 1.8, 6.0, 150.0}) {
            CAPTURE(nu, s);
            const double expected = s < 100 ? on_rigid_base(nu, s) : 1;
            CHECK(relative_compliance({{{1, 7, nu}}, true}, 7 / (1 - nu * nu), s) ==
                  Approx(expected).epsilon(1e-10));
        }
}

TEST_CASE("thick and thin layers have the limits of their own half-space and of the base") {
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
    CHECK(mean_compliance(thin, 1) ==
          Approx(2 / 1e-3 * relative_compliance(thin, own, 1e-3) / own).epsilon(1e-5));
}

TEST_CASE("layers of the body's own modulus change nothing") {
    for (const Extent shape : {Extent{96, 1}, Extent{16, 24}}) {
        const Profile profile = waves(shape, 3);
        Body plain{Kernel::periodic, effective_modulus(3, 0.3)}, same = plain;
        same.layering = {{{0.05, 3, 0.3}, {0.2, 0, 0}}, false, 0.3}; // the second has the base's modulus
        const auto steps = scenes::load_steps(profile, 5, 0.3);
        ContactOptions direct;
        direct.solver = Solver::nested;
        const ContactCurve a = solve_contact(profile, plain, steps, direct),
                           b = solve_contact(profile, same, steps, direct);
        for (std::size_t j = 0; j < steps.size(); ++j) {
            CHECK(b.steps[j].pressure == Approx(a.steps[j].pressure).epsilon(1e-10));
            CHECK(b.steps[j].contact_nodes == a.steps[j].contact_nodes);
        }
    }
}

TEST_CASE("a dense matrix of closed-form compliances gives the curve of a layer on a rigid base") {
    for (const Extent shape : {Extent{64, 1}, Extent{16, 16}})
        for (const double nu : {0.0, 0.3, 0.48})
            for (const double thickness : {0.05, 0.4}) {
                CAPTURE(shape.rows, nu, thickness);
                const Profile profile = waves(shape, 5);
                const Body body = layered(thickness, 7, nu, true);
                for (const double displacement : {0.004, 0.012, 0.03}) {
                    const LoadStep step = solve_contact(profile, body, {displacement}, {}).steps[0];
                    CHECK(step.pressure == Approx(dense_pressure(profile, body, displacement)).epsilon(1e-6));
                    CHECK(step.kkt_residual < 1e-6);
                }
            }
}

TEST_CASE("all solvers agree under layers, by displacement and by load") {
    for (const double nu : {0.1, 0.49})
        for (const bool rigid : {false, true}) {
            CAPTURE(nu, rigid);
            const Profile profile = waves({128, 1}, 9);
            const Body body = layered(0.03, 20, nu, rigid);
            const auto steps = scenes::load_steps(profile, 6, 0.4);
            const ContactCurve curve = solve_contact(profile, body, steps, {});
            std::vector<double> pressures;
            for (const LoadStep& step : curve.steps)
                pressures.push_back(step.pressure);
            for (const Solver solver :
                 {Solver::automatic, Solver::nnls, Solver::polonsky_keer, Solver::active_set}) {
                ContactOptions options;
                options.solver = solver;
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
    // z = h cos q x is in full contact from P = h/(u/p) on; on a rigid base P goes on to rise by 1/C0.
    const double h = 0.01, nu = 0.3, t = 0.1, modulus = 7;
    Profile wave{Eigen::VectorXd(128), 1.0 / 128};
    for (Index i = 0; i < 128; ++i)
        wave.heights[i] = h * std::cos(2 * pi * static_cast<double>(i) / 128);
    const double own = effective_modulus(modulus, nu), q = 2 * pi,
                 full = h * own * q / 2 / on_rigid_base(nu, q * t),
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
    Genome genome = genome_from_json(
        nlohmann::json::parse(R"({"series":[{"A":0.01,"H":0.8,"gamma":1.5,"lambda":1,"chromosomes":[
            {"n":1,"phases":[0.3]},{"n":2,"phases":[2.1]},{"n":3,"phases":[4.0]}]}]})"),
        "genome");
    for (const bool rigid : {false, true}) {
        Model model;
        model.grid = {128, 1, true};
        model.body = layered(0.05, 20, 0.2, rigid);
        model.loading.steps = 6;
        const ResponseJacobian jacobian = testing::jacobian_of(genome, model);
        testing::check_derivatives(genome, model, {{jacobian.pressure, [](const Response& response) {
                                                        return Eigen::VectorXd(response.pressure);
                                                    }}});
    }
}

TEST_CASE("contact sets are known to nest where the inverse says so") {
    const Grid grid{256, 1, true};
    CHECK(contact_sets_nest(Body{Kernel::periodic}, grid));
    CHECK(contact_sets_nest(layered(0.1, 3, 0.3, false), grid)); // the half-space itself
    CHECK_FALSE(contact_sets_nest(layered(0.1, 7, 0.5, true), grid));
}

TEST_CASE("layers without a meaning are refused") {
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
