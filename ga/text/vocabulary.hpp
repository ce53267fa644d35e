#pragma once

#include "ga/ga.hpp"
#include "ga/text/registry.hpp"

namespace ga {

namespace words {

const char* const real_genes = "real genes: genes and with_genes, or a vector of double";
const char* const positions = "genes at positions: a random-access range";
const char* const exchangeable = "genes that may change places";

template <Problem P>
void add_selection(Registry<P>& registry) {
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
}

/// `cross WAY`.
template <class Way, Problem P>
void add_cross(Registry<P>& registry, const char* lacks) {
    registry.template add_if<Crosses<Way, P>, Cross<Way>>(lacks);
}
/// `mutate RATE WAY`.
template <class Way, Problem P>
void add_mutate(Registry<P>& registry, const char* lacks) {
    registry.template add_if<Mutates<Way, P>, Mutate<Way>>(lacks);
}

template <Problem P>
void add_variation(Registry<P>& registry) {
    add_cross<OnePoint>(registry, positions);
    add_cross<Points>(registry, positions);
    add_cross<Uniform>(registry, positions);
    add_cross<Blend>(registry, real_genes);
    add_cross<SimulatedBinary>(registry, real_genes);
    add_cross<Order>(registry, "a permutation for a genome");
    add_mutate<Natural>(registry, "a member mutate, or genes");
    add_mutate<Gaussian>(registry, real_genes);
    add_mutate<UniformStep>(registry, real_genes);
    add_mutate<Polynomial>(registry, "real genes with bounds");
    add_mutate<Reset>(registry, "bits, or genes with bounds");
    add_mutate<Swap>(registry, exchangeable);
    add_mutate<Reverse>(registry, exchangeable);
    registry.template add_if<Sampled<P>, Sample>("a problem that samples genomes");
}

template <Problem P>
void add_replacement(Registry<P>& registry) {
    registry.template add<Elite>();
    registry.template add<Plus>();
    registry.template add<JoinParents>();
    registry.template add<Steady>();
}

template <Problem P>
void add_blocks(Registry<P>& registry) {
    registry.template add<Repeat<Stage<P>>>();
    registry.add({"until", "blocks", "generations until the first condition holds", {}, {}, 1, true},
                 [](const Arguments& a, const std::vector<Stage<P>>& bodies, const Registry<P>& r) {
                     using Rules = RuleList<typename P::Genome>;
                     return Stage<P>(Generations<Stage<P>, Rules>(bodies[0], Rules{r.rules(a)}));
                 });
    registry.template add_rule<AfterGenerations>();
    registry.template add_rule<AfterEvaluations>();
    registry.template add_rule<AfterSeconds>();
    registry.template add_rule<AtFitness>();
    registry.template add_rule<AtStagnation>();
    registry.template add_rule<AtConvergence>();
    registry.template add<Restarts<Stage<P>>>();
    registry.template add<Islands<Stage<P>>>();
}

} // namespace words

/// The engine's operators for a type of problem. Operators that do not work for its genome are listed with
/// their need. ga/text/refinement_vocabulary.hpp adds refinement, ga/text/adaptation_vocabulary.hpp adds
/// learning operators and niches.
template <Problem P>
Registry<P> vocabulary() {
    Registry<P> registry;
    words::add_selection(registry);
    words::add_variation(registry);
    words::add_replacement(registry);
    words::add_blocks(registry);
    return registry;
}

} // namespace ga
