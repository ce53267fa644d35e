#pragma once

#include "domain/mwm/sampling.hpp"

#include <functional>

/// @file
/// Surfaces for tests, benchmarks, and the experiments that compare solvers.
namespace rough {

/// Waves n = 0 to count-1 of a self-affine profile. Their amplitudes are `amplitude` ratio^(-n hurst) (mm),
/// their wavelengths length/ratio^n (mm). In a `periodic` profile wavelengths are the next ones that divide
/// the length. Phases are multiples of the golden angle.
std::vector<Wave> self_affine_waves(double length, double amplitude, double hurst, double ratio, int count,
                                    bool periodic = false);

/// Waves n = 1 to `count` of a fractional-Brownian profile. Their wavelengths are length/n, their amplitudes
/// `amplitude` n^-(hurst + 1/2), both mm. So the power spectral density is ~ k^-(1 + 2 hurst). Phases are
/// (n - 1)^2 golden angles.
std::vector<Wave> brownian_waves(double length, double amplitude, double hurst, int count);

double height_at(const std::vector<Wave>& waves, double x); ///< sum of the waves at x without offsets, mm

/// The heights (mm) that a formula gives at the grid's nodes, x in mm from the first node.
Profile sampled(const Grid& grid, const std::function<double(double)>& height);

/// A self-affine profile that is not an MWM series: fractional Brownian motion by spectral synthesis. Normal
/// random amplitudes have a power spectrum ~ k^-(1 + 2 H) on four times the grid's length. The first quarter
/// is kept, so the profile does not repeat. Its least-squares line is removed, its heights are scaled to
/// `rms` (mm). 0 < hurst < 1. Equal seeds give equal profiles. Throws InputError on values out of range.
Profile fractal_profile(const Grid& grid, double hurst, double rms, std::uint64_t seed);

/// The waves of a profile with wavelengths from `shortest` (exclusive) to `longest` (inclusive).
struct Band {
    double longest;          ///< longest wavelength, mm
    double shortest;         ///< shortest wavelength, mm, less than `longest`
    Eigen::VectorXd heights; ///< heights, mm, with mean 0
};

/// A profile as a sum of octave bands, the longest wavelengths first. Band b has the cosine components with
/// wavelengths from 2L/2^b down to 2L/2^(b+1). The components are those of the profile's even continuation,
/// which has no jump at the ends. The sum of the bands is the profile minus its mean.
std::vector<Band> octave_bands(const Profile& profile);

} // namespace rough
