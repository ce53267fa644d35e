#pragma once

#include "ga/adaptation/vocabulary.hpp"
#include "ga/refinement/vocabulary.hpp"

namespace ga {

/// Every operator of the engine: vocabulary() with refinement, and with what learns or keeps niches. Includes
/// Eigen and NLopt.
template <Problem P>
Registry<P> whole_vocabulary() {
    return with_adaptation(with_refinement(vocabulary<P>()));
}

} // namespace ga
