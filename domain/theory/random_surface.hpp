#pragma once

#include "domain/profile/spectrum.hpp"

#include <cstdint>

namespace rough {

/// A random surface as theories of contact know it: how its mean square height is spread over wave numbers.
struct RandomSurface {
    Spectrum spectrum;   ///< `power` at each wave number; densities are not read
    bool is_area = true; ///< waves of every direction alike; false: a profile, the section of ridges
};

/// The surface with a profile's or a map's own spectrum; `periodic` where it repeats. Throws InputError as
/// continuous_spectrum, and where nothing of it is rough.
RandomSurface random_surface(const Profile& surface, bool periodic = false);

/// A self-affine surface by parameters alone: a power spectral density ~ q^-(1 + 2 H) of a profile, ~ q^-2(1
/// + H) of an area, between two cut-offs.
struct SelfAffine {
    double hurst = 0.8;      ///< H, between 0 and 1
    double longest = 0;      ///< wave length at the long cut-off, mm
    double shortest = 0;     ///< at the short one, mm, less than `longest`
    double rms_slope = 0;    ///< h', > 0: root mean square slope of a profile, gradient of an area
    bool is_area = true;     ///< waves of every direction alike
    Index wave_numbers = 96; ///< into which it is divided, evenly in log q, each with its exact share
};
/// The surface of these parameters. Throws InputError on one out of its range.
RandomSurface random_surface(const SelfAffine& parameters);

/// Mean squares of the height (m0, mm^2), slope (m2) and second derivative (m4, 1/mm^2) of a profile. An
/// area's are the means over its sections in all directions: m0, half of the mean square gradient, and three
/// eighths of the mean square Laplacian, as cos^2 and cos^4 are 1/2 and 3/8 in the mean (Nayak 1971).
struct SpectralMoments {
    double m0 = 0; ///< mm^2
    double m2 = 0; ///< of slopes
    double m4 = 0; ///< 1/mm^2

    double bandwidth() const { return m0 * m4 / (m2 * m2); } ///< Nayak's alpha, at least 1
};
/// The integrals of q^n over the spectrum.
SpectralMoments spectral_moments(const RandomSurface& surface);

/// h': root mean square slope of a profile, gradient of an area.
double rms_slope(const RandomSurface& surface);

/// A surface of these parameters: one cosine for each wave vector of the lattice 2 pi (i/L_x, j/L_y) between
/// the cut-offs, of the spectrum's amplitude and a random phase (so that its power is the spectrum's own), on
/// a grid that is periodic; a line where `parameters` are a profile's. The same seed gives the same surface
/// on every grid; waves that a grid does not resolve are sampled, as they are by an instrument. Throws
/// InputError on parameters out of range, and where no wave fits between the cut-offs.
Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed);

} // namespace rough
