#include "domain/contact/solve.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/theory/theory.hpp"
#include "tests/catch.hpp"
#include "tests/domain/contact/maps.hpp"

#include <boost/math/quadrature/exp_sinh.hpp>

using namespace rough;

namespace {

using std::numbers::pi;

/// A/A0 x rms slope x E* / p at light load.
const double persson_slope = std::sqrt(8 / pi), asperity_slope = std::sqrt(2 * pi);

double normal(double s) { return std::exp(-s * s / 2) / std::sqrt(2 * pi); }

/// int_t^inf (s - t)^n phi(s) ds by another quadrature.
double beyond(double n, double t) {
    boost::math::quadrature::exp_sinh<double> integrator;
    return integrator.integrate([&](double s) { return std::pow(s, n) * normal(t + s); });
}

/// The t at which `beyond` of n has this value, by bisection.
double solved(double n, double value) {
    double low = -5, high = 10;
    for (int k = 0; k < 60; ++k) (beyond(n, (low + high) / 2) > value ? low : high) = (low + high) / 2;
    return low;
}

Eigen::VectorXd at(std::initializer_list<double> pressures) {
    return Eigen::Map<const Eigen::VectorXd>(pressures.begin(), static_cast<Index>(pressures.size()));
}

/// P/K of Persson's theory at light load, mm.
double light_length(const RandomSurface& surface) { return 1e-9 / persson(surface, 1, at({1e-9})).stiffness[0]; }

const SelfAffine usual{.hurst = 0.8, .longest = 1, .shortest = 0.01, .rms_slope = 0.1};

} // namespace

TEST_CASE("moments of a cosine are exact, those of a map are of its sections", "[theory]") {
    const double a = 0.003, k = 2 * pi * 5;
    const Profile line = sampled({200, 1, true}, [&](double x) { return 4 + a * std::cos(k * x); });
    const SpectralMoments of_line = spectral_moments(random_surface(line, true));
    CHECK(of_line.m0 == Approx(a * a / 2).epsilon(1e-12));
    CHECK(of_line.m2 == Approx(a * a / 2 * k * k).epsilon(1e-12));
    CHECK(of_line.m4 == Approx(a * a / 2 * std::pow(k, 4)).epsilon(1e-12));
    // cos kx + cos ky: m2 of a section along x is half of the gradient's mean square
    const Profile map = maps::map_of({80, 100}, 1.0 / 80, 1.0 / 100,
                                     [&](double x, double y) { return a * (std::cos(k * x) + std::cos(k * y)); });
    const RandomSurface area = random_surface(map, true);
    const SpectralMoments of_map = spectral_moments(area);
    CHECK(of_map.m0 == Approx(a * a).epsilon(1e-12));
    CHECK(of_map.m2 == Approx(a * a / 2 * k * k).epsilon(1e-12));
    CHECK(of_map.m4 == Approx(3.0 / 8 * a * a * std::pow(k, 4)).epsilon(1e-12));
    CHECK(rms_slope(area) == Approx(a * k).epsilon(1e-12));
}

TEST_CASE("a self-affine surface has the requested rms slope, cut-offs and moments", "[theory]") {
    for (const bool is_area : {true, false}) {
        SelfAffine of = usual;
        of.is_2d = is_area;
        of.wave_numbers = 2000;
        const RandomSurface surface = random_surface(of);
        CHECK(rms_slope(surface) == Approx(0.1).epsilon(1e-12));
        CHECK(surface.spectrum.wave_number[0] == Approx(2 * pi).epsilon(3e-3));
        const SpectralMoments m = spectral_moments(surface);
        // int q^(n - 1 - 2 H) between the cut-offs
        const auto integral = [](double n) {
            return (std::pow(2 * pi * 100, n - 1.6) - std::pow(2 * pi, n - 1.6)) / (n - 1.6);
        };
        CHECK(m.m0 == Approx(0.01 * integral(0) / integral(2)).epsilon(1e-9));
        CHECK(m.m4 == Approx((is_area ? 3.0 / 8 : 1) * 0.01 * integral(4) / integral(2)).epsilon(1e-3));
    }
    SelfAffine smooth = usual; // H = 1: the integrals of q^-3 and 1/q
    smooth.hurst = 1 - 1e-15;
    CHECK(spectral_moments(random_surface(smooth)).m0 ==
          Approx(0.01 * (1 - 1e-4) / (8 * pi * pi * std::log(100))).epsilon(1e-9));
}

TEST_CASE("stiffness of each theory is in proportion to the modulus", "[theory]") {
    const RandomSurface surface = random_surface(usual);
    for (const Theory theory : {Theory::greenwood_williamson, Theory::persson})
        for (const double p : {1e-5, 1e-3, 5e-3}) {
            const TheoryCurve curve = predicted_curve(theory, surface, 1, at({p, 1.001 * p}));
            INFO(name_of(theory) << " at " << p);
            CHECK(curve.contact_fraction[1] > curve.contact_fraction[0]);
            const TheoryCurve stiffer = predicted_curve(theory, surface, 3, at({3 * p}));
            CHECK(stiffer.contact_fraction[0] == Approx(curve.contact_fraction[0]).epsilon(1e-9));
            CHECK(stiffer.stiffness[0] == Approx(3 * curve.stiffness[0]).epsilon(1e-9));
        }
}

TEST_CASE("Persson's area is the error function, for profiles and areas", "[theory]") {
    for (const bool is_area : {true, false}) {
        SelfAffine of = usual;
        of.is_2d = is_area;
        const TheoryCurve curve = persson(random_surface(of), 2, at({1e-6, 0.02, 1.0}));
        CHECK(curve.contact_fraction[0] * 2 * 0.1 / 1e-6 == Approx(persson_slope).epsilon(1e-6));
        CHECK(curve.contact_fraction[1] == Approx(std::erf(std::sqrt(2) * 0.02 / 0.2)));
        CHECK(curve.contact_fraction[2] == Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("Persson's 1/K is the sum over waves of its integrand", "[theory]") {
    SelfAffine of = usual;
    of.wave_numbers = 20000;
    const Spectrum spectrum = random_surface(of).spectrum;
    for (const double P : {1e-3, 0.02, 0.05}) {
        double square = 0, compliance = 0; // h'^2 up to the middle of each wave
        for (Index k = 0; k < spectrum.power.size(); ++k) {
            const double q = spectrum.wave_number[k], share = q * q * spectrum.power[k] / 2;
            const double slope = std::sqrt(square += share), s = std::sqrt(2) * P / (3 * slope);
            compliance += q / slope * (0.45 + 1.65 * std::pow(std::erf(s), 2)) * std::exp(-s * s) * spectrum.power[k] /
                          (std::sqrt(2 * pi) * P);
            square += share;
        }
        CHECK(persson(random_surface(of), 3, at({P})).stiffness[0] == Approx(1 / compliance).epsilon(1e-3));
    }
}

TEST_CASE("Persson's P/K of a wide spectrum has its closed form at light load", "[theory]") {
    // H = 0.8, short cut-off gone: P/K = gamma h_rms 2 B(1/2, 2) sqrt(0.4 x 1.6) 1.25/sqrt(2 pi)
    SelfAffine of = usual;
    of.shortest = 1e-9;
    of.wave_numbers = 4000;
    const RandomSurface surface = random_surface(of);
    const double height = std::sqrt(spectral_moments(surface).m0), beta = 4.0 / 3;
    CHECK(light_length(surface) / height ==
          Approx(0.45 * 2.5 * beta * std::sqrt(0.4 * 1.6) / std::sqrt(2 * pi)).epsilon(2e-3));
}

TEST_CASE("Greenwood and Williamson's area and stiffness are McCool's integrals at the pressure", "[theory]") {
    const SpectralMoments m = spectral_moments(random_surface(usual));
    const Summits s = summits(m);
    const double unit = 4.0 / 3 * s.density * 1.7 * std::sqrt(s.radius) * std::pow(s.deviation, 1.5);
    const TheoryCurve curve = greenwood_williamson(m, 1.7, at({1e-6, 1e-4, 2e-3}));
    for (Index j = 0; j < 3; ++j) {
        const double t = solved(1.5, curve.pressure[j] / unit);
        CHECK(curve.stiffness[j] == Approx(1.5 * unit / s.deviation * beyond(0.5, t)).epsilon(1e-7));
        CHECK(curve.contact_fraction[j] ==
              Approx(pi * s.density * s.radius * s.deviation * beyond(1, t)).epsilon(1e-7));
    }
    CHECK(std::isnan(greenwood_williamson(m, 1, at({1.0})).contact_fraction[0])); // beyond every summit
}

TEST_CASE("solved isotropic maps lie between Persson and asperities at light load in area", "[theory][areas]") {
    const Profile map = maps::self_affine(128, 0.8, 1, 0.1);
    const RandomSurface surface = random_surface(map, true);
    const double slope = rms_slope(surface), height = std::sqrt(spectral_moments(surface).m0);
    CHECK(slope == Approx(maps::rms_slope(map)).epsilon(0.1)); // differences of neighbours give less
    std::vector<double> pressures;
    for (const double share : {0.02, 0.04, 0.08, 0.12, 0.16}) pressures.push_back(share * slope / 2);
    const ContactCurve exact = solve_contact_at_pressures(map, {Kernel::periodic}, pressures);
    const TheoryCurve predicted =
        persson(surface, 1, Eigen::Map<const Eigen::VectorXd>(pressures.data(), Index(pressures.size())));
    std::vector<double> lengths;
    for (std::size_t j = 0; j < pressures.size(); ++j) {
        const LoadStep& step = exact.steps[j];
        const double kappa = step.contact_fraction * slope / pressures[j];
        if (j < 3) {
            CHECK((kappa > persson_slope && kappa < asperity_slope));
        }
        lengths.push_back(pressures[j] / step.tangent_stiffness / height);
        CHECK(step.tangent_stiffness == Approx(predicted.stiffness[Index(j)]).epsilon(j < 2 ? 0.25 : 0.06));
    }
    const double predicted_length = light_length(surface) / height;
    CHECK(predicted_length == Approx(0.42).epsilon(0.05));
    for (const std::size_t j : {2u, 3u, 4u}) // P/K grows with the load, in theory as well
        CHECK(lengths[j] == Approx(predicted_length).epsilon(0.25));
}

TEST_CASE("a realised surface has its parameters' spectrum and is independent of the grid", "[theory]") {
    for (const bool is_area : {true, false}) {
        SelfAffine of{.hurst = 0.7, .longest = 0.5, .shortest = 1.0 / 16, .rms_slope = 0.2, .is_2d = is_area};
        Grid grid{.nodes = 96, .length = 1, .periodic = true};
        if (is_area) grid.rows = 80, grid.width = 0.8;
        const Profile surface = realised(of, grid, 7), fine = realised(of, refined(grid, 2), 7);
        const RandomSurface random = random_surface(surface, true);
        CHECK(rms_slope(random) == Approx(0.2).epsilon(1e-9));
        for (const Index j : {0, is_area ? 33 : 0})
            for (const Index i : {0, 5, 61})
                CHECK(surface.heights[j * 96 + i] == Approx(fine.heights[2 * j * 192 + 2 * i]).epsilon(1e-9));
        for (Index k = 0; k < random.spectrum.power.size(); ++k)
            if (random.spectrum.wave_number[k] > 2.2 * pi * 16 || random.spectrum.wave_number[k] < 3.8 * pi)
                CHECK(random.spectrum.power[k] < 1e-20);
        CHECK((realised(of, grid, 8).heights - surface.heights).norm() > 0.5 * surface.heights.norm());
    }
    CHECK_THROWS_AS(realised(usual, Grid{}, 1), InputError);
    for (const double slope : {0., -0.1, HUGE_VAL, std::nan("")})
        CHECK_THROWS_AS(random_surface({.hurst = 0.8, .longest = 1, .shortest = 0.01, .rms_slope = slope}), InputError);
}
