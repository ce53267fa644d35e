#pragma once

#include "domain/profile/profile.hpp"

#include <cstdint>
#include <vector>

namespace rough {

/// A self-affine profile that is no MWM series: fractional Brownian motion by spectral synthesis. Normal
/// random amplitudes under a power spectrum ~ k^-(1 + 2 H) on four times the grid's length, of which the
/// first quarter is kept, so that it does not repeat; its least-squares line is taken off and its heights are
/// scaled to `rms` (mm). 0 < hurst < 1. The same seed gives the same profile. Throws InputError on a hurst,
/// rms or grid out of range.
Profile fractal_profile(const Grid& grid, double hurst, double rms, std::uint64_t seed);

/// The waves of a profile from `shortest` (exclusive) to `longest` (inclusive), mm.
struct Band {
    double longest;          ///< wave length, mm
    double shortest;         ///< wave length, mm, less than `longest`
    Eigen::VectorXd heights; ///< mm, mean 0
};

/// Any profile as a sum of octave bands, coarsest first: its cosine components (those of its even
/// continuation, which has no jump at the ends) of wave lengths 2L/2^b to 2L/2^(b+1). Their sum is the
/// profile less its mean.
std::vector<Band> octave_bands(const Profile& profile);

} // namespace rough
