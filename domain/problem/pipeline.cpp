#include "domain/problem/pipeline.hpp"

#include "ga/adaptation/vocabulary.hpp"
#include "ga/refinement/vocabulary.hpp"
#include "ga/text/vocabulary.hpp"

namespace rough {

ga::Registry<DesignProblem> engine_words() {
    return ga::with_adaptation(ga::with_refinement(ga::vocabulary<DesignProblem>()));
}

} // namespace rough

template class ga::Parser<rough::DesignProblem>;
template ga::Result<rough::Genome> ga::run(const rough::Pipeline&, const rough::DesignProblem&,
                                           ga::Population<rough::Genome>, const ga::RunOptions&,
                                           std::vector<ga::Observer<rough::Genome>>,
                                           ga::Keeper<rough::DesignProblem>*);
