#pragma once

#include "domain/problem/made.hpp"

#include <atomic>
#include <cstdint>
#include <limits>

namespace rough {

/// How the tolerance of a design is computed. The number of draws depends only on the grid, unless `seconds`
/// is finite and `fixed_draws` is false.
struct ToleranceOptions {
    std::uint64_t seed = 1;                                   ///< for the draws
    int threads = 0;                                          ///< 0: all; the result does not depend on them
    double seconds = std::numeric_limits<double>::infinity(); ///< wall time; later levels stay NaN
    bool fixed_draws = false;                ///< the number of draws does not depend on `seconds`
    const std::atomic<bool>* stop = nullptr; ///< true ends the work early, as `seconds` does
};

/// Largest errors under which a design keeps a similarity. 0: even without errors the similarity is lower.
/// NaN: not computed in time.
struct ToleranceLevel {
    double similarity = 0; ///< to keep
    double noise_rms = 0;  ///< mm; 95 % of the draws keep it
    double tilt = 0;       ///< height over the length, mm; each smaller tilt in either direction keeps it too
    double scale = 0;      ///< relative error of all heights, as `tilt`
};

/// Similarities under one noise.
struct NoiseQuantile {
    double noise_rms = 0; ///< mm
    double quantile = 0;  ///< 95 % of the draws have at least this similarity
    double median = 0;    ///< median of the draws
    int draws = 0;        ///< number of draws
};

/// The precision that a machine needs to make a design.
struct Tolerance {
    static constexpr double share = 0.95; ///< share of the draws that keep a similarity
    double noise_length = 0;              ///< l, mm
    double similarity = 0;                ///< without errors; NaN: not computed in time
    int draws = 0;                        ///< draws of noise per level
    double share_from = 0;                ///< lower end of the share's 95 % confidence interval
    double share_to = 1;                  ///< its upper end
    std::vector<ToleranceLevel> levels;   ///< 0.99, 0.95, 0.9 and the requested one, the highest first
    std::vector<NoiseQuantile> curve;     ///< sorted by noise
    bool complete = true; ///< false: the time ended before all levels, and a noise may be based on few draws
};

/// The tolerance of a genome in final amplitude on the set-up's grid and load steps, for noise of the
/// correlation length of DesignSetup::errors. Eq. 11 does not rescale the heights of a draw, and displacement
/// counts from its first touch. Noise is tried up to the height range, tilt up to 16 times that and scale up
/// to 0.99. Noise is found with 1,000 draws on lines of up to 4,096 nodes; larger lines and maps get fewer,
/// at least 40. Throws InputError if the design has no response.
Tolerance tolerance_of(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options = {});

/// The lowest similarity under DesignSetup::errors. For noise it is the similarity that 95 % of the draws
/// reach. Tilts are in both directions, on a map along x and y. `draws` is 0 for as many as in tolerance_of.
/// NaN: not computed in time.
double similarity_when_made(const DesignSetup& setup, const Genome& genome,
                            const ToleranceOptions& options = {}, int draws = 0);

} // namespace rough
