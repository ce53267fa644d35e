#pragma once

#include "domain/theory/random_surface.hpp"

#include <string>

namespace rough {

/// Theories of the contact of a rigid, random, Gaussian surface with an elastic half-space, repeated without
/// end, as `periodic` solves it. They need no sampled surface and no contact solution.
enum class Theory { greenwood_williamson, bush_gibson_thomas, persson };

/// greenwood-williamson, bush-gibson-thomas and persson, in the order of Theory.
const std::vector<std::string>& theory_names();
const std::string& name_of(Theory theory); ///< one of them

/// The prediction of a theory at some mean pressures; NaN if it has none.
struct TheoryCurve {
    Eigen::VectorXd pressure;         ///< P, MPa
    Eigen::VectorXd contact_fraction; ///< A/A0
    Eigen::VectorXd stiffness;        ///< K = -dP/du, MPa/mm; periodic, so K = K_i
    Eigen::VectorXd separation;       ///< u, mm, between the mean planes of the surface and the body
};

/// Whether a theory applies: to maps always, to profiles only Persson's. Asperity theories are for maps,
/// because a profile touches along lines.
bool holds_for(Theory theory, bool is_area);

/// The curve of a theory. `effective_modulus` is E*, MPa; pressures are > 0, in any order, MPa. Throws
/// InputError for moments that no Gaussian surface has and for a profile with a theory for maps only.
TheoryCurve predicted_curve(Theory theory, const RandomSurface& surface, double effective_modulus,
                            const Eigen::VectorXd& pressures);

/// Summits as Greenwood & Williamson (1966, Proc. R. Soc. A 295, 300) take them: spheres of one radius,
/// heights normal. Their parameters from a surface's moments after McCool (1986, Wear 107, 37).
struct Summits {
    double density;   ///< eta, 1/mm^2: (m4/m2)/(6 pi sqrt 3)
    double radius;    ///< R, mm: 3 sqrt(pi)/(8 sqrt m4)
    double deviation; ///< sigma_s, mm, of their heights: sigma_s^2 = (1 - 0.8968/alpha) m0
    double mean;      ///< mean of their heights above the mean plane, mm: 4 sqrt(m0/(pi alpha))
};
/// Throws InputError if a moment is not above 0, or alpha is below 1.5, the lowest of an isotropic Gaussian
/// surface (Nayak 1971).
Summits summits(const SpectralMoments& moments);

/// Greenwood & Williamson's curve: each summit is a Hertz contact that does not influence another. A/A0 = pi
/// eta R int_d (s - d) phi, P = 4/3 eta E* sqrt(R) int_d (s - d)^(3/2) phi. Holds at light load, a few
/// percent in contact; NaN beyond the plane of the mean summit (d < 0).
TheoryCurve greenwood_williamson(const SpectralMoments& moments, double effective_modulus,
                                 const Eigen::VectorXd& pressures);

/// Bush, Gibson & Thomas (1975, Wear 35, 87): each summit is an elliptic paraboloid, a Hertz contact that
/// does not influence another. Curvatures and heights have the joint distribution of the summits of an
/// isotropic Gaussian surface (Longuet-Higgins 1957, Nayak 1971). At light load A/A0 -> sqrt(2 pi) P/(E* h').
/// Holds at light load; NaN beyond the mean plane (u < 0).
TheoryCurve bush_gibson_thomas(const SpectralMoments& moments, double effective_modulus,
                               const Eigen::VectorXd& pressures);

/// Persson's theory (2001, J. Chem. Phys. 115, 3840; 2007, Phys. Rev. Lett. 99, 125502): the distribution of
/// the pressure widens as shorter waves are included, and is cut off at zero. A/A0 = erf(sqrt 2 P/(E* h')) at
/// every load, for profiles and maps, because the pressure of full contact varies by E* h'/2 in both.
/// Stiffness follows from the elastic energy. Let h'(q) be the slope of waves up to q, and s = sqrt 2 P/(E*
/// h'(q)). Then 1/K = 1/(sqrt(2 pi) P) int q/h'(q) [gamma + 3 (1 - gamma) erf^2 s] exp(-s^2) dm0. gamma =
/// 0.45 accounts for the parts that contact does not reach (Yang & Persson 2008, J. Phys.: Condens. Matter
/// 20, 215214; 1 in 2007). Exact at full contact. K is best at middle loads, near P/u0; a finite surface is
/// softer at light ones.
TheoryCurve persson(const RandomSurface& surface, double effective_modulus, const Eigen::VectorXd& pressures);

/// u0 of P ~ exp(-u/u0), K = P/u0 as P -> 0, mm: gamma/sqrt(2 pi) int q/h'(q) dm0, about half the root mean
/// square height.
double persson_length(const RandomSurface& surface);

} // namespace rough
