#pragma once

#include "domain/profile/spectrum.hpp"

#include <cstdint>

namespace rough {

/// A random surface as theories of contact describe it: its mean square height, spread over wavenumbers.
struct RandomSurface {
    Spectrum spectrum;   ///< `power` at each wavenumber; densities are not read
    bool is_area = true; ///< isotropic; false: a profile, constant in the second direction
};

/// The surface with the spectrum of a profile or map, `periodic` if it repeats. Throws InputError as
/// continuous_spectrum, and for a flat surface.
RandomSurface random_surface(const Profile& surface, bool periodic = false);

/// A self-affine surface by its parameters. Between two cut-offs the power spectral density is ~ q^-(1 + 2 H)
/// for a profile, ~ q^-2(1 + H) for a map.
struct SelfAffine {
    double hurst = 0.8;      ///< H, between 0 and 1
    double longest = 0;      ///< wavelength at the long cut-off, mm
    double shortest = 0;     ///< at the short one, mm, less than `longest`
    double rms_slope = 0;    ///< h', > 0: root mean square slope of a profile, gradient of a map
    bool is_area = true;     ///< waves of every direction alike
    Index wave_numbers = 96; ///< number of parts of the spectrum, even in log q, each with its exact power
};
/// The surface of these parameters. Throws InputError on one out of its range.
RandomSurface random_surface(const SelfAffine& parameters);

/// Mean squares of the height (m0, mm^2), slope (m2) and second derivative (m4, 1/mm^2) of a profile. Those
/// of a map are means over its sections in all directions. They are m0, 1/2 of the mean square gradient and
/// 3/8 of the mean square Laplacian. 1/2 and 3/8 are the means of cos^2 and cos^4 (Nayak 1971).
struct SpectralMoments {
    double m0 = 0; ///< mm^2
    double m2 = 0; ///< mean square slope
    double m4 = 0; ///< 1/mm^2

    double bandwidth() const { return m0 * m4 / (m2 * m2); } ///< Nayak's alpha, at least 1
};
/// The integrals of q^n over the spectrum.
SpectralMoments spectral_moments(const RandomSurface& surface);

/// h': root mean square slope of a profile, gradient of a map.
double rms_slope(const RandomSurface& surface);

/// A surface of these parameters on a periodic grid; a line if `parameters` are a profile's. It is the sum of
/// one cosine for each wave vector of the lattice 2 pi (i/L_x, j/L_y) between the cut-offs. Amplitudes follow
/// the spectrum and phases are random, so that the power is exactly the spectrum's. The same seed gives the
/// same surface on every grid. Waves that a grid does not resolve are sampled, as by an instrument. Throws
/// InputError for parameters out of range, and if no wave fits between the cut-offs.
Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed);

} // namespace rough
