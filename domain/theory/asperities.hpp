#pragma once

#include "domain/theory/theory.hpp"

namespace rough {

/// int_t^inf (s - t)^n phi(s) ds, phi the standard normal density, for n = 1/2, 1 and 3/2.
struct Exceedances {
    double half;         ///< n = 1/2
    double one;          ///< n = 1
    double three_halves; ///< n = 3/2
};
/// Of t of any size, to about ten digits.
Exceedances exceedances(double t);

/// Summits as Greenwood & Williamson (1966, Proc. R. Soc. A 295, 300) take them: spheres of one radius,
/// heights normal. Their parameters from a surface's moments after McCool (1986, Wear 107, 37).
struct Summits {
    double density;   ///< eta, 1/mm^2: (m4/m2)/(6 pi sqrt 3)
    double radius;    ///< R, mm: 3 sqrt(pi)/(8 sqrt m4)
    double deviation; ///< sigma_s, mm, of their heights: sigma_s^2 = (1 - 0.8968/alpha) m0
    double mean;      ///< of their heights above the mean plane, mm: 4 sqrt(m0/(pi alpha))
};
/// Throws InputError on moments that are not above 0 or whose alpha is under 1.5, the least of an isotropic
/// Gaussian surface (Nayak 1971).
Summits summits(const SpectralMoments& moments);

/// Greenwood & Williamson's curve: each summit a Hertz contact of its own, which feels no other. A/A0 = pi
/// eta R int_d (s - d) phi, P = 4/3 eta E* sqrt(R) int_d (s - d)^(3/2) phi. Holds at light load, a few
/// percent in contact; no number where the plane of the mean summit is passed (d < 0).
TheoryCurve greenwood_williamson(const SpectralMoments& moments, double effective_modulus,
                                 const Eigen::VectorXd& pressures);

/// Bush, Gibson & Thomas (1975, Wear 35, 87): each summit an elliptic paraboloid with the principal
/// curvatures that a Gaussian isotropic surface's summits have together with their heights (Longuet-Higgins
/// 1957, Nayak 1971), pressed as Hertz says, no summit feeling another. At light load A/A0 -> sqrt(2 pi)
/// P/(E* h'). Holds at light load; no number where the mean plane is passed (u < 0).
TheoryCurve bush_gibson_thomas(const SpectralMoments& moments, double effective_modulus,
                               const Eigen::VectorXd& pressures);

/// Summits to a unit area, 1/mm^2, by the integral over the distribution that bush_gibson_thomas presses.
double summit_density(const SpectralMoments& moments);

} // namespace rough
