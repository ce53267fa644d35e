#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// A power spectral density over wavenumbers q: one-sided for a line, radially averaged for a map.
struct Spectrum {
    /// Wavenumbers q_k, rad/mm. For a line q_k = 2 pi k/(N delta), k = 1 .. N/2. For a map q_k is the root mean square
    /// wavenumber of ring k. A ring is as wide as the larger of 2 pi/(N_x delta_x) and 2 pi/(N_y delta_y).
    Eigen::VectorXd wave_number;
    /// Densities C(q_k). For a line in mm^3; the integral of C over q is the mean square height. For a map in
    /// mm^4, the mean over the ring; the integral of 2 pi q C over q is the mean square height.
    Eigen::VectorXd density;
    Eigen::VectorXd power; ///< share of the mean square height at each wavenumber or ring, mm^2
};

/// The continuous spectrum of a sampled surface: the periodogram of its heights minus their mean under a Hann window,
/// scaled by the window's mean square. For a line C(q_k) = 2 |sum_i w_i z_i exp(-i q_k x_i)|^2 delta/(2 pi sum_i
/// w_i^2), and half of it at the Nyquist wavenumber. On a map the window is the product of one along x and one along y.
///
/// Because of the window, a jump between the ends does not affect all wavenumbers. A cosine is spread over
/// about four q_k. A `periodic` surface has no window, so waves that fit it are exact. Throws InputError on
/// fewer than four nodes along x or y.
Spectrum continuous_spectrum(const Profile& surface, bool periodic = false);

/// The power of each wave of a map, mm^2, by the transform of continuous_spectrum(): (N_x/2 + 1) x N_y. The
/// power at -q is added to that at q. Entry (i, j) is the power at q = 2 pi (i/(N_x delta_x), j/(N_y
/// delta_y)). If j is above N_y/2, j - N_y replaces it.
Eigen::ArrayXXd wave_powers(const Profile& surface, bool periodic = false);

} // namespace rough
