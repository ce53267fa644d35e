#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// A power spectral density over wavenumbers q: one-sided for a line, radially averaged for a map.
struct Spectrum {
    /// q_k, rad/mm. Line: 2 pi k/(N delta), k = 1 .. N/2. Map: the root mean square wavenumber of ring k.
    /// A ring is as wide as the larger of 2 pi/(N_x delta_x) and 2 pi/(N_y delta_y).
    Eigen::VectorXd wave_number;
    /// C(q_k). Line: mm^3; its integral over q is the mean square height. Map: mm^4, the mean over the
    /// ring; the integral of 2 pi q C is the mean square height.
    Eigen::VectorXd density;
    Eigen::VectorXd power; ///< mm^2, the line's or the ring's share of the mean square height
};

/// The continuous spectrum of a sampled surface: the periodogram of its heights minus their mean under a
/// Hann window, scaled by the window's mean square. For a line C(q_k) = 2 |sum_i w_i z_i exp(-i q_k
/// x_i)|^2 delta/(2 pi sum_i w_i^2), and half of it at the Nyquist wavenumber. On a map the window is the
/// product of one along x and one along y.
///
/// The window keeps a jump between the ends from filling the spectrum, and spreads a cosine over about
/// four q_k. A `periodic` surface has no window, so waves that fit it are exact. Throws InputError on
/// fewer than four nodes along x or y.
Spectrum continuous_spectrum(const Profile& surface, bool periodic = false);

/// The power of each wave of a map, mm^2, by the same transform: (N_x/2 + 1) x N_y. Waves of -q are added to
/// those of q. Entry (i, j) is the power at q = 2 pi (i/(N_x delta_x), j/(N_y delta_y)), with j - N_y in
/// place of j above N_y/2.
Eigen::ArrayXXd wave_powers(const Profile& surface, bool periodic = false);

} // namespace rough
