#pragma once

#include "domain/problem/made.hpp"

#include <atomic>
#include <cstdint>
#include <limits>

namespace rough {

/// How the tolerance of a design is found. The number of draws depends only on the grid, unless `seconds` is
/// finite and `fixed_draws` is not set.
struct ToleranceOptions {
    std::uint64_t seed = 1;                                   ///< of the draws
    int threads = 0;                                          ///< 0: all; the result does not depend on them
    double seconds = std::numeric_limits<double>::infinity(); ///< wall time; later levels stay NaN
    bool fixed_draws = false;                ///< the number of draws does not depend on `seconds`
    const std::atomic<bool>* stop = nullptr; ///< true ends the work early, as `seconds` does
};

/// Largest errors at which a design keeps a similarity. 0: the design itself does not have it. NaN: there was
/// no time.
struct ToleranceLevel {
    double similarity = 0; ///< that is to be kept
    double noise_rms = 0;  ///< mm: 95 % of the draws keep it
    double tilt = 0;       ///< height over the length, mm: every smaller one of either sign keeps it too
    double scale = 0;      ///< relative error of all heights, as `tilt`
};

/// Similarity of the draws of one noise.
struct NoiseQuantile {
    double noise_rms = 0; ///< mm
    double quantile = 0;  ///< 95 % of the draws have at least this similarity
    double median = 0;    ///< of the draws
    int draws = 0;        ///< how many
};

/// How precise a machine must be to make a design.
struct Tolerance {
    static constexpr double share = 0.95; ///< of the draws of noise
    double noise_length = 0;              ///< l, mm
    double similarity = 0;                ///< of the design without errors; NaN: no time
    int draws = 0;                        ///< of noise, for each level
    double share_from = 0;                ///< lower end of the share's 95 % confidence interval
    double share_to = 1;                  ///< its upper end
    std::vector<ToleranceLevel> levels;   ///< 0.99, 0.95, 0.9 and the requested one, the highest first
    std::vector<NoiseQuantile> curve;     ///< from the smallest noise to the largest
    bool complete = true; ///< false: no time for all levels; a noise may be one that only few draws keep
};

/// The tolerance of a genome in final amplitude on the set-up's grid and load steps, for noise of the
/// correlation length of DesignSetup::errors. A draw's heights are not rescaled by Eq. 11; its displacement
/// counts from its first touch. Noise up to the height range, tilt up to 16 times that and scale up to 0.99
/// are tried. The noise is bracketed with few draws and found with ten times as many: 1,000 for lines of up
/// to 4,096 nodes, fewer for larger lines and for maps, but 40 at least. Throws InputError if the design has
/// no response.
Tolerance tolerance_of(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options = {});

/// Lowest similarity under DesignSetup::errors: that of 95 % of so many draws of the noise, or of as many as
/// in `tolerance_of` if `draws` is 0, and those of both tilts, for a map along x and y. NaN: no time.
double similarity_when_made(const DesignSetup& setup, const Genome& genome,
                            const ToleranceOptions& options = {}, int draws = 0);

} // namespace rough
