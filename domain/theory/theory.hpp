#pragma once

#include "domain/profile/spectrum.hpp"

#include <cstdint>
#include <string>

namespace rough {

/// A random surface as theories of contact describe it: its mean square height, spread over wavenumbers.
struct RandomSurface {
    Spectrum spectrum; ///< spectrum; only `wave_number` and `power` are read
    bool is_2d = true; ///< true: an isotropic map; false: a profile, constant in the second direction
};

/// The surface with the spectrum of a profile or map, `periodic` if it repeats. Throws InputError as
/// continuous_spectrum, and for a flat surface.
RandomSurface random_surface(const Profile& surface, bool periodic = false);

/// A self-affine surface by its parameters. Between two cut-offs the power spectral density is ~ q^-(1 + 2 H)
/// for a profile, ~ q^-2(1 + H) for a map.
struct SelfAffine {
    double hurst = 0.8;      ///< H, between 0 and 1
    double longest = 0;      ///< wavelength at the long cut-off, mm
    double shortest = 0;     ///< wavelength at the short cut-off, mm, less than `longest`
    double rms_slope = 0;    ///< h', > 0: root mean square slope of a profile, gradient of a map
    bool is_2d = true;       ///< true: an isotropic map; false: a profile
    Index wave_numbers = 96; ///< number of parts of the spectrum, even in log q, each with its exact power
};
/// The surface with these parameters. Throws InputError on a parameter out of range.
RandomSurface random_surface(const SelfAffine& parameters);

/// The spectral moments of a profile; for a map their means over its sections in all directions. Factors of a
/// map are the means 1/2 of cos^2 and 3/8 of cos^4 (Nayak 1971).
struct SpectralMoments {
    double m0 = 0; ///< mean square height, mm^2
    double m2 = 0; ///< mean square slope
    double m4 = 0; ///< mean square second derivative, 1/mm^2

    double bandwidth() const { return m0 * m4 / (m2 * m2); } ///< Nayak's alpha, at least 1
};
/// The spectral moments of a surface: integrals of q^0, q^2 and q^4 over its spectrum.
SpectralMoments spectral_moments(const RandomSurface& surface);

/// The root mean square slope h' of a profile, or gradient of a map.
double rms_slope(const RandomSurface& surface);

/// A surface of these parameters on a periodic grid; a line if `parameters` are a profile's. It has one
/// cosine for each wave vector of the lattice 2 pi (i/L_x, j/L_y) between the cut-offs. Amplitudes follow the
/// spectrum, phases are random. The same seed gives the same surface on every grid. Waves that a grid does
/// not resolve are sampled, as by an instrument. Throws InputError for parameters out of range, for a grid
/// that does not fit them, and if no wave fits between the cut-offs.
Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed);

/// Theories of the contact of a rigid, random, Gaussian surface with a `periodic` half-space (README.md).
enum class Theory { greenwood_williamson, persson };

/// The names greenwood-williamson and persson, in the order of Theory.
const std::vector<std::string>& theory_names();
const std::string& name_of(Theory theory); ///< the name of a theory

/// The prediction of a theory at some mean pressures. Values are NaN at pressures for which it has none.
struct TheoryCurve {
    Eigen::VectorXd pressure;         ///< mean pressure P, MPa
    Eigen::VectorXd contact_fraction; ///< real over nominal contact area, A/A0
    Eigen::VectorXd stiffness;        ///< K = -dP/du, MPa/mm; the surface repeats, so K = K_i
};

/// Whether a theory applies to maps (`is_2d`) or profiles. All apply to maps, only Persson's to profiles.
bool holds_for(Theory theory, bool is_2d);

/// The curve of a theory. `effective_modulus` is E*, MPa; pressures are > 0, in any order, MPa. Throws
/// InputError for moments that no Gaussian surface has, and for a profile if the theory is only for maps.
TheoryCurve predicted_curve(Theory theory, const RandomSurface& surface, double effective_modulus,
                            const Eigen::VectorXd& pressures);

/// The summits that Greenwood & Williamson (1966, Proc. R. Soc. A 295, 300) assume: spheres of one radius
/// with normally distributed heights, from spectral moments (McCool 1986, Wear 107, 37).
struct Summits {
    double density;   ///< number of summits per area eta = (m4/m2)/(6 pi sqrt 3), 1/mm^2
    double radius;    ///< radius R = 3 sqrt(pi)/(8 sqrt m4), mm
    double deviation; ///< standard deviation sigma_s of the heights, mm: sigma_s^2 = (1 - 0.8968/alpha) m0
};
/// The summits of a surface with these moments. Throws InputError if a moment is not above 0, or if alpha is
/// below 1.5, the lowest value of an isotropic Gaussian surface (Nayak 1971).
Summits summits(const SpectralMoments& moments);

/// Greenwood & Williamson's curve: each summit is a Hertz contact that does not influence another. A/A0 = pi
/// eta R int_d (s - d) phi, P = 4/3 eta E* sqrt(R) int_d (s - d)^(3/2) phi. s and d are the heights of a
/// summit and of the body above the mean summit, phi is the density of s. NaN if d < 0.
TheoryCurve greenwood_williamson(const SpectralMoments& moments, double effective_modulus,
                                 const Eigen::VectorXd& pressures);

/// Persson's theory (2001, J. Chem. Phys. 115, 3840; 2007, Phys. Rev. Lett. 99, 125502) for profiles and
/// maps: A/A0 = erf(sqrt 2 P/(E* h')), exact at full contact. Stiffness follows from the elastic energy. Let
/// h'(q) be the slope of waves up to q, and s = sqrt 2 P/(E* h'(q)). Then 1/K = 1/(sqrt(2 pi) P) int q/h'(q)
/// [gamma + 3 (1 - gamma) erf^2 s] exp(-s^2) dm0. gamma = 0.45 accounts for the parts that contact does not
/// reach (Yang & Persson 2008, J. Phys.: Condens. Matter 20, 215214; 1 in 2007).
TheoryCurve persson(const RandomSurface& surface, double effective_modulus, const Eigen::VectorXd& pressures);

} // namespace rough
