#pragma once

#include "domain/problem/problem.hpp"
#include "ga/pipeline/run.hpp"
#include "ga/text/parser.hpp"

namespace rough {

/// A pipeline on a design's problem, of which the paper's is one.
using Pipeline = ga::Stage<DesignProblem>;

/// The engine's words for text pipelines on it.
ga::Registry<DesignProblem> engine_words();

} // namespace rough

/// @cond
// Compiled once, in pipeline.cpp: what reads and runs pipelines is most of what the compiler has to do.
extern template class ga::Parser<rough::DesignProblem>;
extern template ga::Result<rough::Genome> ga::run(const rough::Pipeline&, const rough::DesignProblem&,
                                                  ga::Population<rough::Genome>, const ga::RunOptions&,
                                                  std::vector<ga::Observer<rough::Genome>>,
                                                  ga::Checkpointer<rough::DesignProblem>*);
extern template ga::Result<rough::Genome> ga::run_by(ga::Evaluator<rough::DesignProblem>&,
                                                     const rough::Pipeline&, const rough::DesignProblem&,
                                                     ga::Population<rough::Genome>, const ga::RunOptions&,
                                                     std::vector<ga::Observer<rough::Genome>>,
                                                     ga::Checkpointer<rough::DesignProblem>*);
/// @endcond
