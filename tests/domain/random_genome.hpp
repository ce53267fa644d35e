#pragma once

#include "domain/mwm/test_surfaces.hpp"

#include <random>

namespace rough::testing {

inline double uniform(std::mt19937_64& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

/// A genome of the paper's law: H in [0.5, 1.5], gamma in [1.4, 2], waves no shorter than `shortest` (mm).
inline Genome random_genome(std::mt19937_64& random, int series, std::size_t ridges, double length,
                            double shortest) {
    return rough::random_genome([&](double from, double to) { return uniform(random, from, to); }, series,
                                ridges, length, shortest);
}

} // namespace rough::testing
