#pragma once

#include <functional>

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

/// A contact with any symmetric gap g(x), given its slope g'(x) for x >= 0. F = E* int_0^a x
/// g'/sqrt(a^2 - x^2) dx, which must grow with a. Delta = 2/(pi E*) int_0^a ln(2d/b) F'(b) db. The integrals
/// are computed by quadrature to about 1e-12; 0 < a < 2d.
Contact symmetric(const std::function<double(double)>& gap_slope, double a, const HalfPlane& body);

/// Hertz: a parabola with the gap x^2/(2 R).
Contact parabola(double radius, double a, const HalfPlane& body);
double parabola_pressure(double radius, double a, double x, const HalfPlane& body); ///< MPa, |x| <= a

/// A wedge with the gap `slope` |x|.
Contact wedge(double slope, double a, const HalfPlane& body);
double wedge_pressure(double slope, double a, double x, const HalfPlane& body); ///< MPa, infinite at x = 0

/// An indenter with the gap c x^4; c is `coefficient`, 1/mm^3.
Contact quartic(double coefficient, double a, const HalfPlane& body);

/// A flat punch on [-a, a], under a displacement. In a grid +-a are the edges of its outer elements.
Contact punch(double displacement, double a, const HalfPlane& body);

/// Westergaard: a surface with the depth h (1 - cos 2 pi x/wavelength) below its crests; h is `amplitude`.
/// One contact per wavelength; 0 < a <= wavelength/2.
Contact wave(double amplitude, double wavelength, double a, double effective_modulus);

/// A surface of two waves. Its depth below the crests is h1 (1 - cos 2 k x) + h2 (1 - cos 4 k x), with k =
/// pi/wavelength. h2 is above -h1/4 and at most h1/8.
Contact two_waves(double h1, double h2, double wavelength, double a, double effective_modulus);

/// One flat punch per wavelength, under a displacement towards the mean plane.
Contact periodic_punch(double displacement, double wavelength, double a, double effective_modulus);

} // namespace rough::exact
