#pragma once

#include "domain/fitness/dominance.hpp"
#include "ga/ga.hpp"

namespace rough {

/// How far refinement may move a phase from where it was when its genome was first refined.
struct PhaseReach {
    double relative = 0.1; ///< of the phase's own value: the paper's +-10 %, which freezes phases near 0
    double absolute = 0;   ///< rad, added to it
};

/// What roughness adds to the engine's words: which phases refinement moves, how genomes are joined and
/// reduced. `rule` is Algorithm 1.
ga::Variables<Genome> all_phases(PhaseReach reach = {});
ga::Variables<Genome> dominant_phases(std::shared_ptr<const DominanceRule> rule, PhaseReach reach = {});
ga::Variables<Genome> other_phases(std::shared_ptr<const DominanceRule> rule, PhaseReach reach = {});

/// The sum of the two parents as they were scaled when scored: their relative amplitude matters.
ga::Combine<Genome> unite();

/// Keeps a genome's dominant chromosomes alone, its scale as it is.
inline auto reduce(std::shared_ptr<const DominanceRule> rule) {
    return ga::transform("reduce dominant",
                         [rule](const Genome& genome) { return reduced(genome, (*rule)(genome)); });
}

} // namespace rough
