#pragma once

#include "domain/mwm/genome.hpp"
#include "ga/problem/problem.hpp"

#include <functional>

namespace rough {

/// How far refinement may move a phase from where it was when its genome was first refined.
struct PhaseReach {
    double relative = 0.1; ///< of the phase's own value: the paper's +-10 %, which freezes phases near 0
    double absolute = 0;   ///< rad, added to it
};

/// Which chromosomes: by the place of their series and their own in it.
using ChosenChromosomes = std::function<bool(std::size_t series, std::size_t chromosome)>;

/// A variable for each phase of the genome, or of the chosen chromosomes alone.
std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach,
                                          const ChosenChromosomes& chosen = {});

/// The phases of waves whose wavelength (mm) is at least `from` and below `to`.
std::vector<ga::Variable> phases_of_waves(const Genome& genome, double from, double to,
                                          PhaseReach reach = {});

} // namespace rough
