#pragma once

#include "ga/stage.hpp"
#include "ga/text/number.hpp"

namespace ga {

/// A way to mutate a genome in place, each gene by its chance: `std::string text() const` and,
/// constrained by what it uses of the problem, `bool operator()(const P&, Genome&, const Chance&,
/// Stream&) const`, true when a gene changed.
template <class Way, class P>
concept Mutates = Problem<P> && requires(const Way& way, const P& problem, typename P::Genome& genome,
                                         const Chance& chance, Stream& stream) {
    { way(problem, genome, chance, stream) } -> std::same_as<bool>;
};

/// Mutates every individual. One that changes loses its fitness; if it was scored, it becomes a child of its
/// old self.
template <class Way>
struct Mutate : Operator {
    Way way;     ///< how a genome is changed (Mutates)
    double rate; ///< probability of each gene, [0, 1]

    /// Throws UsageError on a rate outside [0, 1].
    Mutate(double r, Way w) : way(std::move(w)), rate(r) {
        if (!(rate >= 0 && rate <= 1))
            throw UsageError("mutate: rate is " + number(rate) + "; expected 0 to 1");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const {
        const std::string words = way.text();
        return "mutate " + number(rate) + (words.empty() ? "" : " ") + words;
    }
    void check(Known& known) const { known.scored.reset(); }

    template <class P>
    requires Mutates<Way, P> Population<typename P::Genome>
    operator()(Population<typename P::Genome> population, Context<P>& context) const {
        const Chance chance(rate);
        for (std::size_t i = 0; i < population.size(); ++i) {
            auto& individual = population[i];
            Stream stream = context.stream(i);
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
