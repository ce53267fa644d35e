#pragma once

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

/// Contacts with a known solution: a symmetric indenter that touches on [-a, a], or one such contact per
/// wavelength. a is in mm.
/// Sources: Johnson (1985, Contact Mechanics, ch. 2, 4, 5 and 13), Westergaard (1939) and Barber (2018,
/// Contact Mechanics, ch. 6 and 7). Displacements are measured from first touch, with the datum distance d
/// (half-plane) or to the mean plane (periodic). No grid is involved.
namespace rough::exact {

/// The load, displacement and stiffness of a contact.
struct Contact {
    double load = 0;         ///< F = P L, N/mm: force per length out of the plane; periodic: per wavelength
    double displacement = 0; ///< Delta, mm
    double stiffness = 0;    ///< dF/dDelta, MPa, equal to the stiffness of a flat punch of this width
};

/// A half-plane's modulus E* and datum distance d.
struct HalfPlane {
    double effective_modulus = 1; ///< MPa
    double datum = 1;             ///< mm
};

using std::numbers::pi;

template <typename F>
inline double integral(const F& f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 12, 1e-13);
}

/// dF/dDelta of a flat punch of half-width a on the half-plane.
inline double punch_stiffness(double a, const HalfPlane& body) {
    return pi * body.effective_modulus / (2 * std::log(2 * body.datum / a));
}

inline double periodic_punch_stiffness(double s, double effective_modulus) {
    return s < 1 ? pi * effective_modulus / (-2 * std::log(s)) : std::numeric_limits<double>::infinity();
}

/// A contact with any symmetric gap g(x), given its slope g'(x) for x >= 0. F = E* int_0^a x
/// g'/sqrt(a^2 - x^2) dx, which must grow with a. Delta = 2/(pi E*) int_0^a ln(2d/b) F'(b) db. The integrals
/// are computed by quadrature to about 1e-12; 0 < a < 2d.
inline Contact symmetric(const std::function<double(double)>& gap_slope, double a, const HalfPlane& body) {
    // With x = b sin t: F(b)/b = E* int_0^(pi/2) sin t g'(b sin t) dt.
    auto load_over_width = [&](double b) {
        return body.effective_modulus *
               integral([&](double t) { return std::sin(t) * gap_slope(b * std::sin(t)); }, 0.0, pi / 2);
    };
    // Integration by parts: int_0^a ln(2d/b) F'(b) db = ln(2d/a) F(a) + int_0^a F(b)/b db.
    const double load = a * load_over_width(a);
    const double displacement =
        2 / (pi * body.effective_modulus) * (std::log(2 * body.datum / a) * load + integral(load_over_width, 0.0, a));
    return {load, displacement, punch_stiffness(a, body)};
}

/// Hertz: a parabola with the gap x^2/(2 R).
inline Contact parabola(double radius, double a, const HalfPlane& body) {
    return {pi * body.effective_modulus * a * a / (4 * radius),
            a * a / (2 * radius) * (std::log(2 * body.datum / a) + 0.5), punch_stiffness(a, body)};
}

inline double parabola_pressure(double radius, double a, double x, const HalfPlane& body) {
    return body.effective_modulus * a / (2 * radius) * std::sqrt(1 - x * x / (a * a));
}

/// A wedge with the gap `slope` |x|.
inline Contact wedge(double slope, double a, const HalfPlane& body) {
    return {body.effective_modulus * slope * a, 2 * slope * a / pi * (std::log(2 * body.datum / a) + 1),
            punch_stiffness(a, body)};
}

inline double wedge_pressure(double slope, double a, double x, const HalfPlane& body) {
    return body.effective_modulus * slope / pi * std::acosh(a / std::abs(x));
}

/// An indenter with the gap c x^4; c is `coefficient`, 1/mm^3.
inline Contact quartic(double coefficient, double a, const HalfPlane& body) {
    const double a4 = coefficient * std::pow(a, 4);
    return {0.75 * pi * body.effective_modulus * a4, 6 * (a4 / 4 * std::log(2 * body.datum / a) + a4 / 16),
            punch_stiffness(a, body)};
}

/// A flat punch on [-a, a], under a displacement. In a grid +-a are the edges of its outer elements.
inline Contact punch(double displacement, double a, const HalfPlane& body) {
    const double stiffness = punch_stiffness(a, body); // Delta = 2F/(pi E*) ln(2d/a)
    return {stiffness * displacement, displacement, stiffness};
}

/// A surface of two waves. Its depth below the crests is h1 (1 - cos 2 k x) + h2 (1 - cos 4 k x), with k =
/// pi/wavelength. h2 is above -h1/4 and at most h1/8; 0 gives Westergaard's wave. One contact per wavelength;
/// 0 < a <= wavelength/2.
inline Contact two_waves(double h1, double h2, double wavelength, double a, double effective_modulus) {
    const double s = std::sin(pi * a / wavelength), s2 = s * s, s4 = s2 * s2, log_s = std::log(s);
    return {pi * effective_modulus * ((h1 + 4 * h2) * s2 - 6 * h2 * s4),
            2 * ((h1 + 4 * h2) * (s2 / 2 - s2 * log_s) - 6 * h2 * (s4 / 4 - s4 * log_s)),
            periodic_punch_stiffness(s, effective_modulus)};
}

/// One flat punch per wavelength, under a displacement towards the mean plane.
inline Contact periodic_punch(double displacement, double wavelength, double a, double effective_modulus) {
    const double stiffness = periodic_punch_stiffness(std::sin(pi * a / wavelength), effective_modulus);
    return {stiffness * displacement, displacement, stiffness};
}

} // namespace rough::exact
