#include "domain/problem/pipeline.hpp"

#include "ga/text/whole_vocabulary.hpp"

namespace rough {

ga::Registry<DesignProblem> engine_words() { return ga::whole_vocabulary<DesignProblem>(); }

} // namespace rough

template class ga::Parser<rough::DesignProblem>;
template ga::Result<rough::Genome> ga::run(const rough::Pipeline&, const rough::DesignProblem&,
                                           ga::Population<rough::Genome>, const ga::RunOptions&,
                                           std::vector<ga::Observer<rough::Genome>>,
                                           ga::Checkpointer<rough::DesignProblem>*);
template ga::Result<rough::Genome> ga::run_by(ga::Evaluator<rough::DesignProblem>&, const rough::Pipeline&,
                                              const rough::DesignProblem&, ga::Population<rough::Genome>,
                                              const ga::RunOptions&, std::vector<ga::Observer<rough::Genome>>,
                                              ga::Checkpointer<rough::DesignProblem>*);
