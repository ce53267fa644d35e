#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// A one-sided power spectral density over wave numbers q.
struct Spectrum {
    Eigen::VectorXd wave_number; ///< q_k = 2 pi k/(N delta), k = 1 .. N/2, rad/mm
    Eigen::VectorXd density;     ///< C(q_k), mm^3: its integral over q is the mean square height
};

/// The continuous spectrum of a sampled profile: the periodogram of its heights less their mean under a Hann
/// window, scaled by the window's mean square, C(q_k) = 2 |sum_i w_i z_i exp(-i q_k x_i)|^2 delta/(2 pi sum_i
/// w_i^2) (half of it at the Nyquist wave number). The window keeps the jump between a profile's ends from
/// filling the spectrum, and spreads a cosine over about four q_k. Throws InputError on fewer than four
/// nodes.
Spectrum continuous_spectrum(const Profile& profile);

} // namespace rough
