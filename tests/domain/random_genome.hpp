#pragma once

#include "domain/mwm/test_surfaces.hpp"

#include <numbers>
#include <random>

namespace rough::testing {

constexpr double paper_length = 0.84942; ///< length of the paper's profiles, mm
constexpr double two_mm = 2;             ///< length of other profiles, mm
constexpr double p_max = 1.6e-4;         ///< highest pressure of the paper, MPa

inline double uniform(std::mt19937_64& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

/// Ranges of a random series' amplitude and Hurst exponent; nothing is drawn if both ends are equal.
struct SeriesRanges {
    double A_from = 0.5, A_to = 2, H_from = 0.5, H_to = 1.5;
};

/// A random genome by numbers uniform(from, to). Each series has every wavelength from `length` down to `shortest`
/// (mm), with gamma from 1.4 to 2. Each chromosome has `ridges` phases.
template <class Uniform>
Genome random_genome(const Uniform& uniform, int series, std::size_t ridges, double length, double shortest,
                     const SeriesRanges& ranges = {}) {
    const auto drawn = [&](double from, double to) { return from < to ? uniform(from, to) : from; };
    Genome genome;
    for (int s = 0; s < series; ++s) {
        Series one{drawn(ranges.A_from, ranges.A_to), drawn(ranges.H_from, ranges.H_to), uniform(1.4, 2), length, {}};
        for (int n = 1; n <= last_chromosome(length, one.gamma, shortest); ++n) {
            one.chromosomes.push_back({n, std::vector<double>(ridges)});
            for (double& phase : one.chromosomes.back().phases) phase = uniform(0, 2 * std::numbers::pi);
        }
        genome.series.push_back(one);
    }
    return genome;
}

/// The same by a generator.
inline Genome random_genome(std::mt19937_64& random, int series, std::size_t ridges, double length, double shortest) {
    return random_genome([&](double from, double to) { return uniform(random, from, to); }, series, ridges, length,
                         shortest);
}

} // namespace rough::testing
