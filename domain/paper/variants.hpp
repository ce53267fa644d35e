#pragma once

#include "domain/paper/dominance.hpp"
#include "domain/problem/phases.hpp"
#include "domain/problem/pipeline.hpp"

namespace rough {

/// What roughness adds to the engine's words: which phases refinement moves, how genomes are joined and
/// reduced.
struct Vocabulary {
    std::shared_ptr<const DominanceRule> rule; ///< Algorithm 1
    PhaseReach reach = {};                     ///< of every refined phase
    /// Gives a sum its amplitude, where Eq. 11 does not; empty: as it is.
    std::function<Genome(const Genome&)> fitted = {};
};

/// The paper's problem: find the genome whose K(p), rescaled by Eq. 11 so that its last load step lies at
/// `max_pressure` (p_max, MPa), is similar to the target. `threshold` is p_bar (MPa), which parts the
/// objectives `low` on [0, p_bar] and `high` on [p_bar, p_max]; phases alone are genes.
DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold,
                        PhaseReach reach = {});

/// How GCMMA sees the similarity.
enum class Form {
    paper,   ///< maximise s|s|: one point of the target at a time
    minimax, ///< minimise t with +-(y(xi_k)/y_k - 1) <= t: all points at once
};

/// The paper's three algorithms (Algorithms 3-5); scoring with Eq. 11 is the problem's. Stages as the paper's
/// Figure 7 counts them: before the first `refine` GCMMA (0), after it (1), after the second (2); CCO has no
/// second.

/// Similarity-optimised genomes: the three best of the database, refined.
Pipeline sog(const Vocabulary& words, Form form = Form::paper);
/// Genome cross-over: sums of genomes that are good at low with genomes that are good at high pressure,
/// refined.
Pipeline gco(const Vocabulary& words, Form form = Form::paper);
/// Chromosome cross-over: the same with each parent reduced to its dominant chromosomes.
Pipeline cco(const Vocabulary& words, Form form = Form::paper);

/// The same with Algorithm 1 on the children in place of the parents: another reading of Algorithm 5.
Pipeline cco_of_sums(const Vocabulary& words);

/// What text pipelines for the paper's problem are made of: the engine's words and roughness's.
ga::Registry<DesignProblem> paper_registry(const Vocabulary& words);

/// sog, gco, cco and their minimax forms as text.
ga::Variants paper_variants();

} // namespace rough
