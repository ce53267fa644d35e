#include "tests/domain/contact/exact.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

using std::numbers::pi;
const exact::HalfPlane half_plane{1.3, 1.0};

/// Worst relative errors over many contact widths and positions of the summit between nodes.
struct Worst {
    double pressure = 0, stiffness = 0;
};

/// gap(x) >= 0 pressed on L = 1, against exact(a) for a in [narrowest, widest].
Worst worst_error(Kernel kernel, Index nodes, const std::function<double(double)>& gap,
                  const std::function<exact::Contact(double)>& exact_contact, double narrowest, double widest) {
    constexpr double length = 1;
    const bool periodic = kernel == Kernel::periodic;
    const Body body{kernel, half_plane.effective_modulus, half_plane.datum};
    Worst worst;
    for (int offset = 0; offset < 7; ++offset) {
        Profile profile{Eigen::VectorXd(nodes), length / static_cast<double>(periodic ? nodes : nodes - 1)};
        const double summit = (static_cast<double>(nodes / 2) + offset / 7.0 - 0.47) * profile.spacing;
        for (Index i = 0; i < nodes; ++i) {
            const double x = std::abs(static_cast<double>(i) * profile.spacing - summit);
            profile.heights[i] = -gap(periodic ? std::min(x, length - x) : x);
        }
        std::vector<double> displacements;
        std::vector<exact::Contact> expected;
        for (int k = 0; k < 40; ++k) {
            const exact::Contact contact = exact_contact(narrowest + (widest - narrowest) * k / 39);
            // The highest node stands a little below the summit.
            displacements.push_back(contact.displacement + profile.heights.maxCoeff());
            expected.push_back(contact);
        }
        const ContactCurve curve = solve_contact(profile, body, displacements);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const LoadStep& step = curve.steps[k];
            worst.pressure = std::max(worst.pressure, std::abs(step.pressure * length / expected[k].load - 1));
            worst.stiffness =
                std::max(worst.stiffness, std::abs(step.tangent_stiffness * length / expected[k].stiffness - 1));
        }
    }
    return worst;
}

void check_orders(Kernel kernel, const std::function<double(double)>& gap,
                  const std::function<exact::Contact(double)>& exact_contact, double narrowest, double widest) {
    const Worst coarse = worst_error(kernel, 128, gap, exact_contact, narrowest, widest);
    const Worst fine = worst_error(kernel, 1024, gap, exact_contact, narrowest, widest);
    const double octaves = 3;
    CHECK(std::log2(coarse.pressure / fine.pressure) / octaves > 1.8);
    CHECK(std::log2(coarse.stiffness / fine.stiffness) / octaves > 0.9);
    CHECK(fine.pressure < 2e-5);
    CHECK(fine.stiffness < 1e-2);
}

} // namespace

TEST_CASE("load converges to second order, stiffness to first, on exact half-plane contacts", "[contact]") {
    const auto check = [](const std::function<double(double)>& gap,
                          const std::function<exact::Contact(double)>& contact) {
        check_orders(Kernel::free, gap, contact, 0.15, 0.4);
    };
    check([](double x) { return x * x / 4; }, [](double a) { return exact::parabola(2, a, half_plane); });
    check([](double x) { return 0.1 * x; }, [](double a) { return exact::wedge(0.1, a, half_plane); });
    check([](double x) { return 3 * std::pow(x, 4); }, [](double a) { return exact::quartic(3, a, half_plane); });
    check([](double x) { return std::cosh(4 * x) - 1; }, // known by its slope only
          [](double a) { return exact::symmetric([](double x) { return 4 * std::sinh(4 * x); }, a, half_plane); });
}

TEST_CASE("load converges to second order, stiffness to first, on exact periodic contacts", "[contact]") {
    const double h2 = GENERATE(-0.2, 0.0, 0.12); // 0: Westergaard's wave
    check_orders(
        Kernel::periodic, [h2](double x) { return 1 - std::cos(2 * pi * x) + h2 * (1 - std::cos(4 * pi * x)); },
        [h2](double a) { return exact::two_waves(1, h2, 1, a, half_plane.effective_modulus); }, 0.1, 0.4);
}

TEST_CASE("a flat punch is too soft by 0.17 delta/(a ln(2d/a))", "[contact]") {
    for (const Index nodes : {64, 256, 1024}) {
        const Body body{.datum = 3};
        const Profile profile{Eigen::VectorXd::Constant(nodes, 5.0), 1.0 / static_cast<double>(nodes - 1)};
        const double a = profile.spacing * static_cast<double>(nodes) / 2, displacement = 0.01;
        const exact::Contact expected = exact::punch(displacement, a, {1, *body.datum});
        const LoadStep step = solve_contact(profile, body, {displacement}).steps.front();
        CHECK(step.contact_nodes == nodes);
        const double softness =
            (1 - step.pressure / expected.load) * a * std::log(2 * *body.datum / a) / profile.spacing;
        CHECK(softness == Approx(0.17).margin(0.015));
        CHECK(step.tangent_stiffness * displacement == Approx(step.pressure).epsilon(1e-6));
    }
}

TEST_CASE("a periodic flat punch converges to first order", "[contact]") {
    auto error = [](Index nodes) {
        const Body body{Kernel::periodic};
        Profile profile{Eigen::VectorXd::Constant(nodes, -1), 1.0 / static_cast<double>(nodes)};
        const Index wide = nodes / 4;
        profile.heights.segment(nodes / 3, wide).setZero();
        const LoadStep step = solve_contact(profile, body, {0.01}).steps.front();
        CHECK(step.contact_nodes == wide);
        const double a = profile.spacing * static_cast<double>(wide) / 2;
        return std::abs(step.pressure / exact::periodic_punch(0.01, 1, a, 1).load - 1);
    };
    CHECK(std::log2(error(128) / error(1024)) / 3 == Approx(1).margin(0.1));
}

TEST_CASE("pressures follow Hertz and the wedge's arccosh inside the contact", "[contact]") {
    const Index nodes = 1025;
    const double a = 0.3;
    const Profile parabola = sampled({nodes, 1}, [](double x) { return -(x - 0.5) * (x - 0.5) / 2; });
    const Profile wedge = sampled({nodes, 1}, [](double x) { return -std::abs(x - 0.5); });
    const Body body{Kernel::free, half_plane.effective_modulus, half_plane.datum};
    const auto hertz =
        solve_contact(parabola, body, {exact::parabola(1, a, half_plane).displacement}, {.states = true});
    const auto sharp = solve_contact(wedge, body, {exact::wedge(1, a, half_plane).displacement}, {.states = true});
    auto check = [&](const ContactState& state, auto pressure_at, double from) {
        for (std::size_t k = 0; k < state.nodes.size(); ++k) {
            const double x = std::abs(state.nodes[k] * parabola.spacing - 0.5);
            if (x > from && x < 0.9 * a)
                CHECK(state.pressure[static_cast<Index>(k)] == Approx(pressure_at(x)).epsilon(3e-3));
        }
    };
    check(
        hertz.states[0], [&](double x) { return exact::parabola_pressure(1, a, x, half_plane); }, -1);
    check(
        sharp.states[0], [&](double x) { return exact::wedge_pressure(1, a, x, half_plane); }, 0.02);
}

TEST_CASE("the master integrals give the closed forms", "[contact]") {
    for (const double a : {1e-3, 0.1, 0.7}) {
        auto same = [](const exact::Contact& x, const exact::Contact& y) {
            CHECK(x.load == Approx(y.load).epsilon(1e-12));
            CHECK(x.displacement == Approx(y.displacement).epsilon(1e-12));
            CHECK(x.stiffness == Approx(y.stiffness).epsilon(1e-12));
        };
        same(exact::symmetric([](double x) { return x / 2; }, a, half_plane), exact::parabola(2, a, half_plane));
        same(exact::symmetric([](double) { return 0.1; }, a, half_plane), exact::wedge(0.1, a, half_plane));
        same(exact::symmetric([](double x) { return 12 * x * x * x; }, a, half_plane),
             exact::quartic(3, a, half_plane));
    }
}

TEST_CASE("a wave closes at Westergaard's pressure of full contact", "[contact]") {
    constexpr double h = 0.02, wavelength = 0.7, E = 1.3;
    const double full = pi * E * h / wavelength;
    const Body body{Kernel::periodic, E};
    const Profile two = sampled({64, 2 * wavelength, true}, // two waves
                                [&](double x) { return h * std::cos(2 * pi * x / wavelength); });
    CHECK(full_contact_load(two, body) == Approx(full).epsilon(1e-12));
    for (const double scale : {1.0, 1e-6}) // at a displacement of h
        CHECK_THROWS_WITH(solve_contact({scale * two.heights, two.spacing}, body, {1.001 * scale * h}),
                          Catch::Contains("beyond full contact"));
}
