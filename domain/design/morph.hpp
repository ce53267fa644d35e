#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// The name of a chromosome: the number of its series and its n.
struct ChromosomeName {
    std::size_t series; ///< number of the series, from 1, in the genome's order
    int n;              ///< Chromosome::n

    bool operator==(const ChromosomeName&) const = default; ///< equal series and n
};

/// Reads names of chromosomes, e.g. "1:3,1:5". Throws InputError about the setting `control` on a text of
/// another form. Also throws it on a chromosome that the genome does not have or that is named twice.
std::vector<ChromosomeName> chromosomes_from(const std::string& text, const Genome& genome);

/// The change of one phase.
struct PhaseChange {
    GenePlace place;       ///< place of the phase among the genes
    int n;                 ///< Chromosome::n
    double before;         ///< phase before the change, rad
    double after;          ///< phase after the change, rad
    bool at_limit = false; ///< whether the change is the largest allowed
};

/// A point of a target whose misfit is larger than allowed.
struct MissedPoint {
    std::size_t target; ///< index of the target, from 0
    double x;           ///< x of the point, in the target's units
    double misfit;      ///< weighted misfit, as in the similarity
};

/// A genome that was changed to match its targets again.
struct Morphed {
    Genome genome;                    ///< as from in_final_form()
    double before = 0;                ///< similarity of the given genome on the set-up's grid
    double after = 0;                 ///< similarity of the changed genome
    std::vector<PhaseChange> changes; ///< one per controlled phase
    std::vector<MissedPoint> missed;  ///< points that miss the required similarity; empty if none does
    long gradients = 0;               ///< number of computed curves with derivatives
    std::optional<Answer> verified;   ///< the changed genome's verification; only on a map
};

/// The smallest change (sum of squares) of the phases of a few chromosomes after which a genome matches the
/// set-up's targets again. x are the changes of the phases, and r_k the misfits. |x|^2 is minimised subject
/// to |r_k| <= 1 - required for all k. The method is sequential quadratic programming (Kraft 1988; NLopt's
/// LD_SLSQP) with exact derivatives.
///
/// On a map the required similarity is that of the surface (Verification::worst). If the change misses it, the
/// targets are corrected once (corrected_targets).
///
/// If the constraints cannot be met, the result is the genome whose largest misfit is the smallest. Limits on shape
/// count as misfits. `control` names at least one chromosome. Only the phases of these chromosomes change.
/// `largest_change` limits the change of a phase. It is a share of a turn, > 0 and <= 0.5. `required` is the required
/// similarity on the set-up's grid. Throws what DesignProblem throws, and InputError on a genome without a response.
Morphed morph(const DesignSetup& setup, const Genome& genome, const std::vector<ChromosomeName>& control,
              double largest_change, double required = default_required_similarity);

/// A changed genome as a SearchResult, verified on finer grids and in finer load steps.
SearchResult as_found(const DesignSetup& setup, const Morphed& morphed);

} // namespace rough
