#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Replaces every genome by function(genome), in parallel. An individual keeps its identity and loses its
/// fitness. If the function throws, the individual keeps its genome and is marked as failed. The failure is
/// under the objective that scored the individual, or under the problem's first objective.
template <class Function>
struct Transform : Operator {
    std::string name; ///< name of the stage
    /// Function from a genome, and a Work if it is one, to a genome; called from several threads.
    Function function;

    std::string text() const { return name; }
    void check(CheckState& known) const { known.scored.reset(); }

    template <Problem P>
    requires gives_with_work<Function, typename P::Genome, const typename P::Genome&> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        std::vector<Work> work(population.size());
        parallel_for(population.size(), context.threads(), [&](std::size_t i) {
            auto& individual = population[i];
            if (individual.fitness.has_failed()) return;
            try {
                individual.genome = with_work(function, work[i], std::as_const(individual.genome));
                individual.fitness = {};
            } catch (...) {
                const Fitness& fitness = individual.fitness;
                individual.fitness = Fitness::failed(
                    fitness.known() ? fitness.objective_name() : context.objective_name(0), reason_caught());
            }
        });
        context.charge(work);
        return population;
    }
};

/// The stage that applies a function to every genome.
/// @param name  name in text pipelines; more words may follow the first ("reduce dominant")
template <class Function>
Transform<Function> transform(std::string name, Function function) {
    return {{}, std::move(name), std::move(function)};
}

} // namespace ga
