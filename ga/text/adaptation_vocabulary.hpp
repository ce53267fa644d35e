#pragma once

#include "ga/adaptation/adaptation.hpp"
#include "ga/text/vocabulary.hpp"

namespace ga {

/// Adds the operators that learn from one generation to the next, and those that keep niches, to a
/// vocabulary.
template <Problem P>
Registry<P> with_adaptation(Registry<P> registry) {
    const char* const described = "features of its genomes: descriptors";
    registry.template add_if<HasGenes<P>, CmaEs>(words::real_genes);
    registry.template add_if<HasGenes<P>, DifferentialEvolution>(words::real_genes);
    registry.template add_if<HasGenes<P>, LShade>(words::real_genes);
    registry.template add_if<HasGenes<P>, SelfAdaptive>(words::real_genes);
    registry.template add<Duel>();
    registry.template add_if<Constrained<P>, Epsilon>("constraints: violation(outcome)");
    registry.template add_if<HasDistance<P>, Proportional<Sharing>>(no_distance);
    registry.template add_if<HasDistance<P>, Clearing>(no_distance);
    registry.template add_if<HasDistance<P>, Crowding>(no_distance);
    registry.template add_if<Describing<P>, MapElites>(described);
    registry.template add_if<Describing<P> && HasGenes<P>, Emit>(described);
    return registry;
}

} // namespace ga
