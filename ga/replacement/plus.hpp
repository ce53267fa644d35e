#pragma once

#include "ga/selection/best.hpp"

namespace ga {

/// Adds the individuals of the generation's start that are not there any more.
template <class G>
Population<G> joined_with(const Population<G>& start, Population<G> population) {
    std::vector<Identity> present;
    for (const auto& individual : population)
        present.push_back(individual.identity);
    std::sort(present.begin(), present.end());
    for (const auto& old : start)
        if (!std::binary_search(present.begin(), present.end(), old.identity))
            population.push_back(old);
    return population;
}

/// (mu + lambda) replacement (Schwefel 1975): the mu best of the generation's start and its children
/// together.
struct Plus : Operator {
    std::size_t mu; ///< 0 for as many as there were at the start

    /// `plus size`; 0 for as many as there were at the start.
    explicit Plus(std::size_t size) : mu(size) {}
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return mu > 0 ? "plus " + std::to_string(mu) : "plus"; }
    std::size_t reads_of_start() const { return everyone; }
    Demand demand() const { return {.best = mu > 0 ? mu : Demand::as_many_as_start, .with_start = true}; }
    void check(Known& known) const {
        known.need_generation(text());
        known.need_score(text());
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        const auto& start = context.generation_start();
        return best_of(joined_with(start, std::move(population)), mu > 0 ? mu : start.size());
    }
    ///@}
};

/// The stage `plus mu`.
inline Plus plus(std::size_t mu = 0) { return Plus(mu); }

/// Adds the generation's start to the population without choosing, for a ranking of all together.
struct JoinParents : Operator {
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "parents"; }
    std::size_t reads_of_start() const { return everyone; }
    void check(Known& known) const { known.need_generation(text()); }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        return joined_with(context.generation_start(), std::move(population));
    }
    ///@}
};

/// The stage `parents`.
inline JoinParents parents() { return {}; }

/// Steady-state replacement (Whitley 1989): the population is that of the generation's start with its worst
/// individuals replaced by the children, whatever these are worth. `tournament 2 size=2` before makes two
/// children a generation.
struct Steady : Operator {
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "steady"; }
    std::size_t reads_of_start() const { return everyone; }
    void check(Known& known) const {
        known.need_generation(text());
        known.need_score(text());
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> children,
                                              Context<P>& context) const {
        auto population = context.generation_start();
        const std::vector<std::size_t> order = ranking(population);
        const std::size_t count = std::min(children.size(), population.size());
        for (std::size_t i = 0; i < count; ++i)
            population[order[order.size() - 1 - i]] = std::move(children[i]);
        return population;
    }
    ///@}
};

/// The stage `steady`.
inline Steady steady() { return {}; }

} // namespace ga
