#pragma once

#include "domain/mwm/sampling.hpp"

namespace rough {

/// The layout of the paper's database (section 4.1): Sobol pairs (H, gamma) times Sobol phase columns.
struct DatabaseLayout {
    int pairs = 20;          ///< number of Sobol points (H, gamma)
    int phase_columns = 5;   ///< number of Sobol phase vectors; each is combined with each pair
    double H_from = 0.5;     ///< lowest Hurst exponent
    double H_to = 1.5;       ///< highest Hurst exponent
    double gamma_from = 1.4; ///< lowest ratio of neighbouring wavenumbers, > 1
    double gamma_to = 2.0;   ///< highest ratio of neighbouring wavenumbers
    double A = 1;            ///< amplitude of every series (Series::A)
    double lambda = 0.84942; ///< longest wavelength, mm
    double shortest = 0;     ///< shortest wavelength, mm (the paper: the node spacing)
    int ridges = 1;          ///< number of ridges M of each chromosome; on a map they are directions
};

/// The pairs (H, gamma): Boost's two-dimensional Sobol sequence from its second point, in the ranges.
std::vector<std::pair<double, double>> sobol_pairs(const DatabaseLayout& layout);

/// The phases: entry [n-1][column] is 2 pi u, n = 1..last. u is the n-th point of the Sobol sequence with one
/// dimension per column. The first point is skipped.
std::vector<std::vector<double>> sobol_phases(int columns, int last);

/// The genomes of the database, each of one series: each pair with every phase column in turn. Chromosomes are n =
/// 1..n_f (Eq. 4). The phases of chromosome n are the n-th point of the phase sequence, one column per ridge.
std::vector<Genome> sobol_database(const DatabaseLayout& layout);

} // namespace rough
