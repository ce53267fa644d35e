#pragma once

#include "domain/paper/dominance.hpp"
#include "domain/problem/problem.hpp"
#include "ga/text/compiled_once.hpp"

namespace rough {

/// A pipeline on a design's problem, e.g. the paper's.
using Pipeline = ga::Stage<DesignProblem>;

/// Parameters of the operators that the domain of roughness adds to the engine.
struct Vocabulary {
    std::shared_ptr<const DominanceRule> rule; ///< Algorithm 1, for dominant phases and `reduce dominant`
    PhaseReach reach = {};                     ///< range of every refined phase
    /// Sets the amplitude of a sum of genomes if Eq. 11 does not. Empty: the amplitude is kept.
    std::function<Genome(const Genome&)> fitted = {};
};

/// The paper's problem: the genome whose K(p) is most similar to the target after Eq. 11 has rescaled its
/// last load step to `max_pressure` (p_max, MPa). `threshold` is p_bar (MPa): the objective `low` is on [0,
/// p_bar], `high` on [p_bar, p_max]. Only phases are genes.
DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold,
                        PhaseReach reach = {});

/// The form of the objective that is refined. s is the similarity.
enum class Form {
    paper,   ///< maximise s|s|, which depends on one point of the target at a time
    minimax, ///< minimise t subject to +-(y(xi_k)/y_k - 1) <= t for all points (xi_k, y_k) of the target
};

// The paper's Algorithms 3-5. Figure 7 of the paper numbers the states: (0) before the first `refine`, (1)
// after it, (2) after the second `refine`. CCO has only one `refine`.

/// Similarity-optimised genomes: the three best of the database, refined.
Pipeline sog(const Vocabulary& words, Form form = Form::paper);
/// Genome cross-over: sums of two genomes, one that is good at low pressure and one that is good at high
/// pressure, refined.
Pipeline gco(const Vocabulary& words, Form form = Form::paper);
/// Chromosome cross-over: GCO with each parent reduced to its dominant chromosomes.
Pipeline cco(const Vocabulary& words, Form form = Form::paper);

/// CCO with Algorithm 1 on the children instead of the parents: another reading of Algorithm 5.
Pipeline cco_of_sums(const Vocabulary& words);

/// The operators of text pipelines for the paper's problem: operators of the engine and operators for rough
/// surfaces.
ga::Registry<DesignProblem> paper_registry(const Vocabulary& words);

/// sog, gco, cco and their minimax forms as texts.
ga::Variants paper_variants();

} // namespace rough

/// @cond
GA_PIPELINES_ELSEWHERE(rough::DesignProblem)
/// @endcond
