#include "domain/asperities/design.hpp"
#include "ga/text/whole_vocabulary.hpp"

namespace rough {

ga::Registry<CapProblem> cap_engine_words() { return ga::whole_vocabulary<CapProblem>(); }

} // namespace rough

GA_PIPELINES_HERE(rough::CapProblem)
