#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// (mu + lambda) replacement (Schwefel 1975): the mu best of the generation's start and its children
/// together. Under several objectives both are ranked together: NSGA-II's replacement (Deb et al. 2002).
struct Plus : Operator {
    std::size_t mu = 0; ///< 0 for as many as there were at the start
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"plus", "replacement", "the mu best of the generation's start and its children"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.mu, whole("mu", "0", 0, "how many; 0 for as many as at the start").quiet());
    }
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        return best_of(joined_with(start, std::move(population)), mu > 0 ? mu : start.size());
    }
    ///@}
};

/// The stage `plus mu`.
inline Plus plus(std::size_t mu = 0) { return {{}, mu}; }

/// Adds the generation's start to the population without choosing, for a ranking of all together.
struct JoinParents : Operator {
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"parents", "replacement",
                "adds the generation's start, for what follows to choose among all"};
    }
    static void describe(auto&, auto) {}
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const {
        known.need_generation(text_of(*this));
        if (known.scored != known.start_scored)
            known.scored.reset();
    }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        context.need_room(population.size() + start.size(), population);
        return joined_with(start, std::move(population));
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
    static Words words() {
        return {"steady", "replacement", "the generation's start with its worst replaced by the children"};
    }
    static void describe(auto&, auto) {}
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> children, Context<P>& context) const {
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
