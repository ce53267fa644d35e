#pragma once

#include "domain/mwm/waves.hpp"

#include <numbers>
#include <random>

namespace rough::testing {

inline double uniform(std::mt19937_64& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

/// A genome of the paper's law: H in [0.5, 1.5], gamma in [1.4, 2], waves no shorter than `shortest` (mm).
inline Genome random_genome(std::mt19937_64& random, int series, std::size_t ridges, double length,
                            double shortest) {
    Genome genome;
    for (int s = 0; s < series; ++s) {
        Series one{uniform(random, 0.5, 2), uniform(random, 0.5, 1.5), uniform(random, 1.4, 2), length, {}};
        for (int n = 1; n <= last_chromosome(length, one.gamma, shortest); ++n) {
            one.chromosomes.push_back({n, std::vector<double>(ridges)});
            for (double& phase : one.chromosomes.back().phases)
                phase = uniform(random, 0, 2 * std::numbers::pi);
        }
        genome.series.push_back(one);
    }
    return genome;
}

} // namespace rough::testing
