#pragma once

#include "ga/text/adaptation_vocabulary.hpp"
#include "ga/text/refinement_vocabulary.hpp"

namespace ga {

/// Every operator of the engine: vocabulary() with refinement, learning operators and niches. Includes Eigen
/// and NLopt.
template <Problem P>
Registry<P> whole_vocabulary() {
    return with_adaptation(with_refinement(vocabulary<P>()));
}

} // namespace ga
