#pragma once

#include "domain/mwm/sampling.hpp"

namespace rough {

/// How the paper's database is laid out (section 4.1): Sobol pairs (H, gamma) times Sobol phase columns.
struct DatabaseLayout {
    int pairs = 20;          ///< Sobol points (H, gamma)
    int phase_columns = 5;   ///< Sobol phase vectors, combined with each pair
    double H_from = 0.5;     ///< least Hurst exponent
    double H_to = 1.5;       ///< greatest Hurst exponent
    double gamma_from = 1.4; ///< least ratio of neighbouring wave numbers, > 1
    double gamma_to = 2.0;   ///< greatest ratio of neighbouring wave numbers
    double A = 1;            ///< amplitude of every series; with lambda in mm, the unit that makes heights mm
    double lambda = 0.84942; ///< mm
    bool with_first = false; ///< both sequences with their first point, the middle
    double shortest = 0;     ///< shortest wave length admitted, mm (the paper: the grid's spacing)
    int ridges = 1;          ///< of a chromosome, M; an area takes them as directions
};

/// The pairs (H, gamma): Boost's two-dimensional Sobol sequence, its first point skipped unless the layout
/// has it, mapped to the ranges.
std::vector<std::pair<double, double>> sobol_pairs(const DatabaseLayout& layout);

/// phases[n-1][column] = 2 pi u of the Sobol sequence of that many dimensions, its first point skipped
/// unless asked for; n = 1..last.
std::vector<std::vector<double>> sobol_phases(int columns, int last, bool with_first = false);

/// Genomes of a single series, pair by pair, each with every phase column in turn: chromosomes n = 1..n_f
/// (Eq. 4), the phases of chromosome n from the n-th point of the phase sequence, a column a ridge.
std::vector<Genome> sobol_database(const DatabaseLayout& layout);

} // namespace rough
