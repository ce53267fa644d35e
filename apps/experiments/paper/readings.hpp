#pragma once

#include "apps/experiments/paper/run.hpp"
#include "apps/report/plot.hpp"

namespace app {

/// What Algorithm 1 keeps of one genome under one reading of its correlation.
struct Reduction {
    double kept = 0;        ///< share of the chromosomes, 0..1
    double similarity = 0;  ///< of the reduced profile's K(p) with the whole's, both at p_max (Eq. 12)
    bool only_best = false; ///< none passed 0.95
};

/// How far a genome's curves move when half of its waves go: the mean relative change, at equal pressures
/// that both profiles reach; NaN where what is left is flat.
struct Removal {
    double stiffness = unset, area = unset;
};

/// What the run's numbers owe to our reading of the paper, measured on the database; a row a genome.
struct Readings {
    std::vector<Reduction> same_pressure, same_step;
    std::vector<Removal> without_coarse,
        without_fine;                     ///< the longer half of the waves gone; the shorter half
    double datum_factor = 4;              ///< the other datum, times the run's
    std::vector<double> datum_similarity; ///< of a genome's K(p) at the other datum with its own
    std::vector<double> datum_best; ///< a target each: the database's best similarity at the other datum
};

Readings readings_of(const PaperRun& run);

/// What a rule of Algorithm 1 keeps of each genome of the run's database.
std::vector<Reduction> reductions(const PaperRun& run, const rough::DominanceRule& rule);
/// How each genome's curves move without one half of its waves.
void add_removals(const PaperRun& run, Readings& readings);

} // namespace app
