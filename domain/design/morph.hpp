#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// A chromosome by its series and its number.
struct ChromosomeName {
    std::size_t series; ///< from 1, in the genome's order
    int n;              ///< Chromosome::n

    bool operator==(const ChromosomeName&) const = default; ///< equal series and n
};

/// Reads "1:3,1:5". Throws InputError about the setting `control` on another form, a chromosome that the
/// genome does not have, or one named twice.
std::vector<ChromosomeName> chromosomes_from(const std::string& text, const Genome& genome);

/// The change of one phase.
struct PhaseChange {
    GenePlace place;       ///< its gene
    int n;                 ///< Chromosome::n
    double before;         ///< rad
    double after;          ///< rad
    bool at_limit = false; ///< the change is the largest allowed
};

/// A point of a target whose misfit is larger than allowed.
struct PointOff {
    std::size_t target; ///< from 0
    double x;           ///< in the target's units
    double misfit;      ///< weighted, as in the similarity
};

/// A genome that was changed to match its targets again.
struct Morphed {
    Genome genome;                    ///< in final amplitude
    double before = 0;                ///< similarity of the given genome on the set-up's grid
    double after = 0;                 ///< similarity of the changed genome
    std::vector<PhaseChange> changes; ///< one per controlled phase
    std::vector<PointOff> off;        ///< empty if the required similarity is reached
    long gradients = 0;               ///< computed curves with derivatives
};

/// The smallest change (sum of squares) of the phases of a few chromosomes after which a genome matches the
/// set-up's targets again. It minimises |x|^2 subject to |r_k| <= 1 - required for every misfit r_k, by
/// sequential quadratic programming (Kraft 1988; NLopt's LD_SLSQP) with exact derivatives. The search starts
/// from the given genome. If it fails, it starts again from the result of Levenberg-Marquardt. If the
/// constraints cannot be met, the result has the smallest largest misfit. Limits on shape count as misfits.
///
/// `control` has at least one chromosome. Only their phases change, whatever the set-up's genes.
/// `largest_change` of a phase is a share of a turn, > 0 and <= 0.5. `required` is the required similarity on
/// the set-up's grid.
///
/// Throws what DesignProblem throws, and InputError on a genome without a response.
Morphed morph(const DesignSetup& setup, const Genome& genome, const std::vector<ChromosomeName>& control,
              double largest_change, double required = default_required_similarity);

/// A changed genome as the result of a search, verified on finer grids and with finer load steps.
SearchResult as_found(const DesignSetup& setup, const Morphed& morphed);

} // namespace rough
