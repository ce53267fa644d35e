#include "domain/contact/exact.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace rough::exact {

namespace {

constexpr double pi = std::numbers::pi;

template <typename F>
double integral(const F& f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 12, 1e-13);
}

/// dF/dDelta of a flat punch of half-width a on the half-plane.
double punch_stiffness(double a, const HalfPlane& body) {
    return pi * body.effective_modulus / (2 * std::log(2 * body.datum / a));
}

double periodic_punch_stiffness(double s, double effective_modulus) {
    return s < 1 ? pi * effective_modulus / (-2 * std::log(s)) : std::numeric_limits<double>::infinity();
}

} // namespace

Contact symmetric(const std::function<double(double)>& gap_slope, double a, const HalfPlane& body) {
    // With x = b sin t: F(b)/b = E* int_0^(pi/2) sin t g'(b sin t) dt.
    auto load_over_width = [&](double b) {
        return body.effective_modulus *
               integral([&](double t) { return std::sin(t) * gap_slope(b * std::sin(t)); }, 0.0, pi / 2);
    };
    // Integration by parts: int_0^a ln(2d/b) F'(b) db = ln(2d/a) F(a) + int_0^a F(b)/b db.
    const double load = a * load_over_width(a);
    const double displacement = 2 / (pi * body.effective_modulus) *
                                (std::log(2 * body.datum / a) * load + integral(load_over_width, 0.0, a));
    return {load, displacement, punch_stiffness(a, body)};
}

Contact parabola(double radius, double a, const HalfPlane& body) {
    return {pi * body.effective_modulus * a * a / (4 * radius),
            a * a / (2 * radius) * (std::log(2 * body.datum / a) + 0.5), punch_stiffness(a, body)};
}

double parabola_pressure(double radius, double a, double x, const HalfPlane& body) {
    return body.effective_modulus * a / (2 * radius) * std::sqrt(1 - x * x / (a * a));
}

Contact wedge(double slope, double a, const HalfPlane& body) {
    return {body.effective_modulus * slope * a, 2 * slope * a / pi * (std::log(2 * body.datum / a) + 1),
            punch_stiffness(a, body)};
}

double wedge_pressure(double slope, double a, double x, const HalfPlane& body) {
    return body.effective_modulus * slope / pi * std::acosh(a / std::abs(x));
}

Contact quartic(double coefficient, double a, const HalfPlane& body) {
    const double a4 = coefficient * std::pow(a, 4);
    return {0.75 * pi * body.effective_modulus * a4, 6 * (a4 / 4 * std::log(2 * body.datum / a) + a4 / 16),
            punch_stiffness(a, body)};
}

Contact punch(double displacement, double a, const HalfPlane& body) {
    const double stiffness = punch_stiffness(a, body); // Delta = 2F/(pi E*) ln(2d/a)
    return {stiffness * displacement, displacement, stiffness};
}

Contact wave(double amplitude, double wavelength, double a, double effective_modulus) {
    return two_waves(amplitude, 0, wavelength, a, effective_modulus);
}

Contact two_waves(double h1, double h2, double wavelength, double a, double effective_modulus) {
    const double s = std::sin(pi * a / wavelength), s2 = s * s, s4 = s2 * s2, log_s = std::log(s);
    return {pi * effective_modulus * ((h1 + 4 * h2) * s2 - 6 * h2 * s4),
            2 * ((h1 + 4 * h2) * (s2 / 2 - s2 * log_s) - 6 * h2 * (s4 / 4 - s4 * log_s)),
            periodic_punch_stiffness(s, effective_modulus)};
}

Contact periodic_punch(double displacement, double wavelength, double a, double effective_modulus) {
    const double stiffness = periodic_punch_stiffness(std::sin(pi * a / wavelength), effective_modulus);
    return {stiffness * displacement, displacement, stiffness};
}

} // namespace rough::exact
