#pragma once

#include "domain/paper/rescaled_problem.hpp"
#include "domain/paper/vocabulary.hpp"

namespace rough {

/// How GCMMA sees the similarity.
enum class Form {
    paper,   ///< maximise s|s|: one point of the target at a time
    minimax, ///< minimise t with +-(y(xi_k)/y_k - 1) <= t: all points at once
};

/// A pipeline on the paper's problem.
using PaperPipeline = ga::Stage<RescaledProblem>;

/// The paper's three algorithms (Algorithms 3-5); scoring with Eq. 11 is the problem's. Stages as the paper's
/// Figure 7 counts them: before the first `refine` GCMMA (0), after it (1), after the second (2); CCO has no
/// second.

/// Similarity-optimised genomes: the three best of the database, refined.
PaperPipeline sog(const Vocabulary& words, Form form = Form::paper);
/// Genome cross-over: sums of genomes that are good at low with genomes that are good at high pressure,
/// refined.
PaperPipeline gco(const Vocabulary& words, Form form = Form::paper);
/// Chromosome cross-over: the same with each parent reduced to its dominant chromosomes.
PaperPipeline cco(const Vocabulary& words, Form form = Form::paper);

/// What text pipelines for the paper's problem are made of: the engine's words and roughness's.
ga::Registry<RescaledProblem> paper_registry(const Vocabulary& words);

/// sog, gco, cco and their minimax forms as text.
ga::Variants paper_variants(const Vocabulary& words);

} // namespace rough
