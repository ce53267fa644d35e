#pragma once

#include "domain/paper/dominance.hpp"
#include "domain/problem/problem.hpp"
#include "ga/text/compiled_once.hpp"

#include <memory>

namespace rough {

using DesignPipeline = ga::Pipeline<DesignProblem>; ///< a pipeline on a design's problem, e.g. the paper's

/// Parameters of the operators that the domain of roughness adds to the engine.
struct Vocabulary {
    std::shared_ptr<const DominanceRule> rule; ///< Algorithm 1, for dominant phases and `reduce dominant`
    PhaseReach reach = {};                     ///< range of every refined phase
    /// Sets the amplitude of a sum of genomes if Eq. 11 does not. Empty: the amplitude is kept.
    std::function<Genome(const Genome&, ga::Work&)> fitted = {};
};

/// The paper's problem: the genome whose K(p) is most similar to the target after Eq. 11 has rescaled its
/// last load step to `max_pressure` (p_max, MPa). `threshold` is p_bar (MPa): the objective `low` is on [0,
/// p_bar], `high` on [p_bar, p_max]. Only phases are genes.
DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold, PhaseReach reach = {});

/// The operators of text pipelines for the paper's problem: those of the engine and for rough surfaces.
ga::Registry<DesignProblem> paper_registry(const Vocabulary& words);

/// The variants in a text of lines NAME = TEXT. An indented line continues the text; # begins a comment.
ga::Variants variants_in(const std::string& ini);

/// The paper's Algorithms 3-5 (sog, gco, cco) and their minimax forms as texts, see variants.ini.
ga::Variants paper_variants();

} // namespace rough

/// @cond
GA_PIPELINES_ELSEWHERE(rough::DesignProblem)
/// @endcond
