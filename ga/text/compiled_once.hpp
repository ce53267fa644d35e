#pragma once

#include "ga/text/parser.hpp"
#include "ga/text/vocabulary.hpp"

/// @file
/// Compiles the text pipelines of a problem in only one file of a program, because they compile slowly. Both
/// macros stand at global scope (ga/README.md, "A new variant").

/// Declares that the vocabulary, the parser and `run` of a problem are compiled in another file. Write it
/// after the problem's definition in its header.
#define GA_PIPELINES_ELSEWHERE(P) GA_PIPELINES_OF(extern template, P)
/// Compiles the vocabulary, the parser and `run` of a problem in this file.
#define GA_PIPELINES_HERE(P) GA_PIPELINES_OF(template, P)

/// @cond
#define GA_PIPELINES_OF(instantiate, P)                                                                                \
    instantiate ga::Registry<P> ga::vocabulary<P>();                                                                   \
    instantiate class ga::Parser<P>;                                                                                   \
    instantiate ga::Result<P::Genome> ga::run(const ga::Pipeline<P>&, const P&, ga::Population<P::Genome>,             \
                                              const ga::RunOptions&, std::vector<ga::Observer<P::Genome>>,             \
                                              ga::Checkpointer<P>*);                                                   \
    instantiate ga::Result<P::Genome> ga::run_by(ga::Evaluator<P>&, const ga::Pipeline<P>&, const P&,                  \
                                                 ga::Population<P::Genome>, const ga::RunOptions&,                     \
                                                 std::vector<ga::Observer<P::Genome>>, ga::Checkpointer<P>*);
/// @endcond
