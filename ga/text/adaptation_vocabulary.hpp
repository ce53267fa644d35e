#pragma once

#include "ga/adaptation/adaptation.hpp"
#include "ga/text/vocabulary.hpp"

namespace ga {

/// Adds the operators that learn from one generation to the next, and those that keep niches, to a
/// vocabulary.
template <Problem P>
Registry<P> with_adaptation(Registry<P> registry) {
    registry.template add<CmaEs, DifferentialEvolution, LShade, SelfAdaptive, Duel, Epsilon,
                          Proportional<Sharing>, Clearing, Crowding, MapElites, Emit>();
    return registry;
}

} // namespace ga
