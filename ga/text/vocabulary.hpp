#pragma once

#include "ga/ga.hpp"
#include "ga/text/registry.hpp"

namespace ga {

namespace words {

const char* const real_genes = "real genes: genes and with_genes, or a vector of double";
const char* const positions = "genes at positions: a random-access range";
const char* const exchangeable = "genes that may change places";

} // namespace words

/// The engine's operators for a type of problem. Operators that do not work for its genome are listed with
/// the reason. ga/text/refinement_vocabulary.hpp adds refinement, ga/text/adaptation_vocabulary.hpp adds
/// learning operators and niches.
template <Problem P>
Registry<P> vocabulary() {
    Registry<P> registry;
    registry.template add<Score>();
    registry.template add_if<Noisy<P>, Average>("a noisy evaluation (evaluate(genome, replicate))");
    registry.template add<Best>();
    registry.template add<Threshold<true>>();
    registry.template add<Threshold<false>>();
    registry.template add<Tournament>();
    registry.template add<Proportional<Roulette>>();
    registry.template add<Proportional<Universal>>();
    registry.template add<Proportional<ByRank>>();
    registry.template add<Random>();
    registry.template add<Pareto>();
    registry.template add<Front>();

    registry.template add_if<Crosses<OnePoint, P>, Cross<OnePoint>>(words::positions);
    registry.template add_if<Crosses<Points, P>, Cross<Points>>(words::positions);
    registry.template add_if<Crosses<Uniform, P>, Cross<Uniform>>(words::positions);
    registry.template add_if<Crosses<Blend, P>, Cross<Blend>>(words::real_genes);
    registry.template add_if<Crosses<SimulatedBinary, P>, Cross<SimulatedBinary>>(words::real_genes);
    registry.template add_if<Crosses<Order, P>, Cross<Order>>("a permutation for a genome");
    registry.template add_if<Mutates<Natural, P>, Mutate<Natural>>("a member mutate, or genes");
    registry.template add_if<Mutates<Gaussian, P>, Mutate<Gaussian>>(words::real_genes);
    registry.template add_if<Mutates<UniformStep, P>, Mutate<UniformStep>>(words::real_genes);
    registry.template add_if<Mutates<Polynomial, P>, Mutate<Polynomial>>("real genes with bounds");
    registry.template add_if<Mutates<Reset, P>, Mutate<Reset>>("bits, or genes with bounds");
    registry.template add_if<Mutates<Swap, P>, Mutate<Swap>>(words::exchangeable);
    registry.template add_if<Mutates<Reverse, P>, Mutate<Reverse>>(words::exchangeable);
    registry.template add_if<Sampled<P>, Sample>("a problem that samples genomes");

    registry.template add<Elite>();
    registry.template add<Plus>();
    registry.template add<JoinParents>();
    registry.template add<Steady>();

    registry.template add<Repeat<Stage<P>>>();
    registry.add({"until", "blocks", "generations until the first condition holds", {}, {}, 1, true},
                 [](const Arguments& a, const std::vector<Stage<P>>& bodies, const Registry<P>& r) {
                     return Stage<P>(until_step<P>(bodies[0], r.rules(a)));
                 });
    registry.template add_rule<AfterGenerations>();
    registry.template add_rule<AfterEvaluations>();
    registry.template add_rule<AfterSeconds>();
    registry.template add_rule<AtFitness>();
    registry.template add_rule<AtStagnation>();
    registry.template add_rule<AtConvergence>();
    registry.template add<Restarts<Stage<P>>>();
    registry.template add<Islands<Stage<P>>>();
    return registry;
}

} // namespace ga
