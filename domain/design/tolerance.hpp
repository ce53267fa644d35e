#pragma once

#include "domain/problem/making_errors.hpp"

#include <atomic>

namespace rough {

/// Options of the tolerance of a design. The number of draws depends on the grid and the price. It depends on
/// the time only if `seconds` is finite and `fixed_draws` is false.
struct ToleranceOptions {
    std::uint64_t seed = 1; ///< seed of the draws
    int threads = 0;        ///< number of threads, 0: all; the result does not depend on it
    /// Wall time, s. Sizes that are not found by then stay NaN.
    double seconds = std::numeric_limits<double>::infinity();
    /// Price of the curves to solve, in curves of the set-up's model. If it is small, fewer errors are tried.
    double price = std::numeric_limits<double>::infinity();
    std::optional<int> draws = {};           ///< number of draws of noise, whatever they cost; none: from the price
    bool fixed_draws = false;                ///< whether the number of draws ignores `seconds`
    const std::atomic<bool>* stop = nullptr; ///< true ends the work early, as `seconds` does
};

/// The largest errors under which a design keeps a similarity. Each error acts without the other two. An
/// error is 0 if the similarity is lower even without errors, and NaN if it was not computed in time.
struct ToleranceLevel {
    double similarity = 0; ///< the similarity to keep
    double noise_rms = 0;  ///< rms of height noise, mm, under which 95 % of the draws keep the similarity
    /// Tilt as a difference in height over the length, mm. Each smaller tilt in either direction keeps the
    /// similarity, too.
    double tilt = 0;
    /// Relative error of all heights. Each smaller error of either sign keeps the similarity, too.
    double scale = 0;
};

/// Similarities of draws of noise with one rms.
struct NoiseQuantile {
    double noise_rms = 0; ///< rms of the noise, mm
    double quantile = 0;  ///< 95 % of the draws have at least this similarity
    double median = 0;    ///< median similarity of the draws
    int draws = 0;        ///< number of draws
};

/// The precision that a machine needs to make a design.
struct Tolerance {
    static constexpr double share = 0.95; ///< share of the draws that keep a similarity
    double noise_length = 0;              ///< correlation length of the noise, mm
    double similarity = 0;                ///< similarity without errors; NaN: not computed in time
    int draws = 0;                        ///< number of draws of noise per level; 0: not computed in time
    double share_from = 0;                ///< lower end of the share's 95 % confidence interval
    double share_to = 1;                  ///< upper end of this interval
    std::vector<ToleranceLevel> levels;   ///< levels 0.99, 0.95, 0.9 and the required similarity, falling
    std::vector<NoiseQuantile> curve;     ///< similarities under each noise that was tried, by rising noise
    /// Whether all levels were found in time. If not, a noise may be based on few draws.
    bool complete = true;
    bool shortened = false; ///< whether fewer errors were tried because time was short
};

/// The tolerance of a genome from in_final_form() on the set-up's grid and load steps. The noise has the
/// correlation length of DesignSetup::errors. Eq. 11 does not rescale the heights of a draw, and displacement
/// counts from the first touch of the draw.
///
/// Noise is tried up to the height range, tilt up to 16 times the height range and scale up to 0.99. There are 1,000
/// draws of noise on lines of up to 4,096 nodes, and fewer on larger ones and maps. At least 40 are drawn, or 5 if time
/// or price is short. Throws InputError if the design has no response.
Tolerance tolerance_of(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options = {});

/// The lowest similarity under DesignSetup::errors. For noise it is the similarity that 95 % of the draws
/// reach. Tilts are in both directions, on a map along x and y. NaN: not computed in time.
double similarity_under_errors(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options = {});

} // namespace rough
