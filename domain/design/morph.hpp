#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// A chromosome by the names that a user gives: its series' place from 1, and its own n there.
struct ChromosomeName {
    std::size_t series; ///< from 1, in the genome's order
    int n;              ///< Chromosome::n

    bool operator==(const ChromosomeName&) const = default; ///< the same chromosome
};

/// Reads "1:3,1:5". Throws InputError about the setting `control` on another form, a chromosome that the
/// genome has not, or one named twice.
std::vector<ChromosomeName> chromosomes_from(const std::string& text, const Genome& genome);

/// How one phase was moved.
struct PhaseChange {
    GenePlace place;       ///< which one
    int n;                 ///< of its chromosome
    double before;         ///< rad
    double after;          ///< rad
    bool at_limit = false; ///< it was moved as far as it may
};

/// A point of a target that was left off by more than was asked.
struct PointOff {
    std::size_t target; ///< which, from 0
    double x;           ///< where, in the target's units
    double misfit;      ///< weighted, as similarity counts it
};

/// A genome brought back to its targets.
struct Morphed {
    Genome genome;                    ///< in final amplitude
    double before = 0;                ///< similarity of the genome as it was given, on the set-up's grid
    double after = 0;                 ///< the same of the morphed one
    std::vector<PhaseChange> changes; ///< of every controlled phase
    std::vector<PointOff> off;        ///< empty where the similarity that was asked for is reached
    long gradients = 0;               ///< curves with derivatives that were computed
};

/// The least change of the phases of a few chromosomes, in the sum of squares, that brings a genome's answer
/// back to the set-up's targets: minimise |x|^2 subject to |r_k| <= 1 - reach for every misfit r_k, by
/// sequential quadratic programming (Kraft 1988; NLopt's LD_SLSQP) with exact derivatives from the genome's
/// own curve, and once more from what Levenberg-Marquardt finds where that fails. Where that cannot be met,
/// the least largest misfit. Limits on shape count as misfits do.
/// @param control         at least one; their phases alone move, whatever the set-up's genes
/// @param largest_change  of a phase, over a whole turn; above 0, at most 0.5
/// @param reach           the similarity to come back to, on the set-up's grid
/// Throws what DesignProblem throws, and InputError on a genome without an answer.
Morphed morph(const DesignSetup& setup, const Genome& genome, const std::vector<ChromosomeName>& control,
              double largest_change, double reach = default_required_similarity);

/// A morphed genome as a search's answer, verified on finer grids and in finer load steps.
SearchResult as_found(const DesignSetup& setup, const Morphed& morphed);

} // namespace rough
