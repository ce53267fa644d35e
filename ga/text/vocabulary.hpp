#pragma once

#include "ga/ga.hpp"
#include "ga/text/registry.hpp"

namespace ga {

/// The engine's operators for a type of problem. Operators that do not work for its genome are listed with
/// the reason. ga/text/whole_vocabulary.hpp adds refinement, learning operators and niches.
template <Problem P>
Registry<P> vocabulary() {
    Registry<P> registry;
    registry.template add<Score, Average, Best, Threshold<true>, Threshold<false>, Tournament, Proportional<Roulette>,
                          Proportional<Universal>, Proportional<ByRank>, Random, Distinct, Pareto, Front,
                          HypervolumeSelection, ReferenceDirections>();
    registry
        .template add<Cross<OnePoint>, Cross<Points>, Cross<Uniform>, Cross<Blend>, Cross<SimulatedBinary>,
                      Cross<Order>, Cross<PartiallyMapped>, Cross<EdgeRecombination>, Mutate<Natural>, Mutate<Gaussian>,
                      Mutate<UniformStep>, Mutate<Polynomial>, Mutate<Reset>, Mutate<Swap>, Mutate<Reverse>,
                      Mutate<Insertion>, Mutate<OrOpt>, Sample, SampleEvenly<false>, SampleEvenly<true>>();
    registry.template add<Elite, Plus, JoinParents, Steady, Repeat<Pipeline<P>>>();
    registry.add({"until", "blocks", "generations until the first condition holds", {}, {}, 1, true},
                 [](const Arguments& a, const std::vector<Pipeline<P>>& bodies, const Registry<P>& r) {
                     return Pipeline<P>(until_stage<P>(bodies[0], r.rules(a)));
                 });
    registry
        .template add_rule<AfterGenerations, AfterEvaluations, AfterSeconds, AtFitness, AtStagnation, AtConvergence>();
    registry.template add<Restarts<Pipeline<P>>, Islands<Pipeline<P>>>();
    return registry;
}

} // namespace ga
