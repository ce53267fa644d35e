#pragma once

#include "domain/paper/dominance.hpp"
#include "ga/problem.hpp"

namespace rough {

/// How far refinement may move a phase from where it was when its genome was first refined.
struct PhaseReach {
    double relative = 0.1; ///< of the phase's own value: the paper's +-10 %, which freezes phases near 0
    double absolute = 0;   ///< rad, added to it
};

/// A variable for each phase of the genome, or of its dominant chromosomes alone, or of the others.
std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach);
/// Those of dominant chromosomes alone.
std::vector<ga::Variable> dominant_phase_variables(const Genome& genome, const Dominance& dominance,
                                                   PhaseReach reach);
/// Those of the other chromosomes.
std::vector<ga::Variable> other_phase_variables(const Genome& genome, const Dominance& dominance,
                                                PhaseReach reach);

/// Those of macro-roughness, waves of at least an eighth of the profile's length (mm). Where the one ends
/// and the other begins is our reading.
std::vector<ga::Variable> macro_phases(const Genome& genome, double length, PhaseReach reach = {});
/// Those of micro-roughness, the shorter waves.
std::vector<ga::Variable> micro_phases(const Genome& genome, double length, PhaseReach reach = {});

} // namespace rough
