#include "domain/problem/pipeline.hpp"

#include "ga/text/whole_vocabulary.hpp"

namespace rough {

ga::Registry<DesignProblem> engine_words() { return ga::whole_vocabulary<DesignProblem>(); }

} // namespace rough

GA_PIPELINES_HERE(rough::DesignProblem)
