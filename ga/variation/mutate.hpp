#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// A way to mutate a genome in place, each gene by its chance: words() and describe() as an operator has,
/// and, constrained by what it uses of the problem, `bool operator()(const P&, Genome&, const Chance&,
/// Stream&) const`, true when a gene changed.
template <class Way, class P>
concept Mutates = Problem<P> && requires(const Way& way, const P& problem, typename P::Genome& genome,
                                         const Chance& chance, Stream& stream) {
    { way(problem, genome, chance, stream) } -> std::same_as<bool>;
};

/// "mutate 0.1 gaussian 0.2".
[[gnu::cold]] inline std::string mutation_text(double rate, const std::string& name,
                                               const std::string& values) {
    return "mutate " + number(rate) + (name.empty() ? "" : " " + name) + (values.empty() ? "" : " " + values);
}

/// Mutates every individual. One that changes loses its fitness; if it was scored, it becomes a child of its
/// old self.
template <class Way>
struct Mutate : Operator {
    double rate = 0; ///< probability of each gene, [0, 1]
    Way way;         ///< how a genome is changed (Mutates)
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        const Words of_way = Way::words();
        return {"mutate" + (of_way.name.empty() ? "" : " " + of_way.name), "mutation", of_way.meaning};
    }
    static void describe(auto& self, auto visit) {
        visit(self.rate, number("rate", std::nullopt, 0, 1, "a gene's chance to mutate"));
        Way::describe(self.way, visit);
    }
    std::string text() const { return mutation_text(rate, Way::words().name, values_in_words(way)); }
    void check(CheckState& known) const { known.scored.reset(); }

    template <class P>
    requires Mutates<Way, P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        const Chance chance(rate);
        Stream next = context.stream(0); // made ahead, while the processor waits for the one before
        for (std::size_t i = 0; i < population.size(); ++i) {
            auto& individual = population[i];
            Stream stream = std::exchange(next, context.stream(i + 1));
            if (!way(context.problem(), individual.genome, chance, stream))
                continue;
            if (individual.fitness.known())
                context.make_child(individual, Parents(individual.identity));
        }
        return population;
    }
    ///@}
};

} // namespace ga
