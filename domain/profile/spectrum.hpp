#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// A power spectral density over wave numbers q, one-sided of a line, radially averaged of an area.
struct Spectrum {
    /// q_k, rad/mm: 2 pi k/(N delta) of a line, k = 1 .. N/2; of an area the root mean square wave number of
    /// ring k, whose width is the larger of 2 pi/(N_x delta_x) and 2 pi/(N_y delta_y)
    Eigen::VectorXd wave_number;
    /// C(q_k): of a line mm^3, its integral over q is the mean square height; of an area mm^4, the mean of
    /// the ring's waves, the integral of 2 pi q C
    Eigen::VectorXd density;
    Eigen::VectorXd power; ///< mm^2, the line's or the ring's share of the mean square height
};

/// The continuous spectrum of a sampled surface: the periodogram of its heights less their mean under a Hann
/// window, scaled by the window's mean square, of a line C(q_k) = 2 |sum_i w_i z_i exp(-i q_k x_i)|^2
/// delta/(2 pi sum_i w_i^2) (half of it at the Nyquist wave number). The window keeps the jump between a
/// profile's ends from filling the spectrum, and spreads a cosine over about four q_k; of an area it is the
/// product of one along x and one along y. A surface that `periodic` is taken without: exact for waves that
/// fit it. Throws InputError on fewer than four nodes along x or y.
Spectrum continuous_spectrum(const Profile& surface, bool periodic = false);

/// The power of each wave of an area, mm^2, by the same transform: N_y rows of N_x/2 + 1, those of -q in
/// those of q: entry (i, j) is that of q = 2 pi (i/(N_x delta_x), j/(N_y delta_y)), j - N_y for j over N_y/2.
Eigen::ArrayXXd wave_powers(const Profile& surface, bool periodic = false);

} // namespace rough
