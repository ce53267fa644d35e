#pragma once

#include "domain/fitness/rescaled_problem.hpp"
#include "domain/variants/vocabulary.hpp"

namespace rough {

/// How GCMMA sees the similarity.
enum class Form {
    paper,   ///< maximise s|s|: one point of the target at a time
    minimax, ///< minimise t with +-(y(xi_k)/y_k - 1) <= t: all points at once
};

/// What the three algorithms share besides the problem.
struct PaperChoices {
    std::shared_ptr<const DominanceRule> rule; ///< Algorithm 1
    Form form = Form::paper;
    PhaseReach reach = {}; ///< of every refined phase
};

using PaperPipeline = ga::Stage<RescaledProblem>;

/// The paper's three algorithms (Algorithms 3-5); scoring with Eq. 11 is the problem's. Stages as the paper's
/// Figure 7 counts them: before the first `refine` GCMMA (0), after it (1), after the second (2); CCO has no
/// second.

/// Similarity-optimised genomes: the three best of the database, refined.
PaperPipeline sog(const PaperChoices& choices);
/// Genome cross-over: sums of genomes that are good at low with genomes that are good at high pressure,
/// refined.
PaperPipeline gco(const PaperChoices& choices);
/// Chromosome cross-over: the same with each parent reduced to its dominant chromosomes.
PaperPipeline cco(const PaperChoices& choices);

} // namespace rough
