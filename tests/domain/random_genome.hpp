#pragma once

#include "domain/mwm/test_surfaces.hpp"

#include <random>

namespace rough::testing {

constexpr double paper_length = 0.84942; ///< length of the paper's profiles, mm
constexpr double two_mm = 2;             ///< length of other profiles, mm
constexpr double p_max = 1.6e-4;         ///< highest pressure of the paper, MPa

inline double uniform(std::mt19937_64& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

/// A genome of the paper's law: H in [0.5, 1.5], gamma in [1.4, 2], waves no shorter than `shortest` (mm).
inline Genome random_genome(std::mt19937_64& random, int series, std::size_t ridges, double length, double shortest) {
    return rough::random_genome([&](double from, double to) { return uniform(random, from, to); }, series, ridges,
                                length, shortest);
}

} // namespace rough::testing
