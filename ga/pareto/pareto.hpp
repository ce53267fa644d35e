#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Scores by several objectives at once. Individuals are compared as NSGA-II does (Deb et al. 2002): by the
/// rank of their front, then by crowding. Those that violate constraints come last (Deb's rules). Rank and
/// crowding refer to the individuals that a stage compares, so every selection and replacement works:
///
///     pareto({"f1", "f2"})
///         | repeat(250, tournament(2) | cross(sbx()) | mutate(0.03, polynomial()) | pareto({"f1", "f2"}) |
///         plus()) | front()
struct Pareto : Operator {
    std::vector<std::string> objectives; ///< names, two at least, each once
    /// Throws UsageError on less than two, or one twice.
    [[gnu::cold]] void validate() const {
        if (objectives.size() < 2)
            throw UsageError("pareto compares " + std::to_string(objectives.size()) +
                             " objectives; give the names of 2 or more");
        for (auto each = objectives.begin(); each != objectives.end(); ++each)
            if (std::find(objectives.begin(), each, *each) != each)
                throw UsageError("pareto is given '" + *each + "' twice; give different objectives");
    }
    ///@{ What every operator has (Operator).
    static Words words() {
        return {"pareto", "selection", "scores by several objectives: NSGA-II's rank and crowding"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.objectives, word_list("objectives", "two of the problem's or more"));
    }
    void check(CheckState& known) const {
        for (const auto& objective : objectives)
            known.objective(text_of(*this), objective);
        known.scored = text_of(*this);
    }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        std::vector<const Objective<typename P::Outcome>*> read;
        bool with_first = false; // the run stores the best under it
        for (const auto& objective : objectives) {
            const std::size_t which = context.objective_index(objective);
            read.push_back(&context.problem().objectives()[which]);
            with_first |= which == 0;
        }
        const Name name(text_of(*this)), first = context.objective_name(0);
        const auto all = [](const auto&) { return true; };
        context.visit(population, all, [&](auto& individual, const auto& evaluation) {
            Point point;
            std::vector<double> violations;
            for (const auto* objective : read) {
                const Fitness one = fitness_of(context.problem(), evaluation, *objective, name);
                if (one.has_failed()) {
                    individual.fitness = one;
                    return;
                }
                point.push_back(one.merit());
                violations = one.violations();
            }
            if (with_first) {
                individual.fitness =
                    fitness_of(context.problem(), evaluation, context.problem().objectives()[0], first);
                context.offer(individual);
            }
            individual.fitness = Fitness(name, std::move(point)).constrained(std::move(violations));
        });
        return population;
    }
    ///@}
};

/// The stage `pareto objective objective ...`.
inline Pareto pareto(std::vector<std::string> objectives) {
    return checked(Pareto{{}, std::move(objectives)});
}

/// Keeps the individuals that no other one dominates.
struct Front : Operator {
    ///@{ What every operator has (Operator).
    static Words words() {
        return {"front", "selection", "keeps the individuals that no other one dominates, after pareto"};
    }
    void check(CheckState& known) const {
        if (!known.several_objectives())
            throw UsageError("stage 'front' needs a population ranked by pareto; put pareto before it");
    }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        auto front = ga::front_of(population);
        if (front.empty())
            throw NothingLeft(context.path() + ": every one of " + std::to_string(population.size()) +
                              " individuals failed; the first: " + population.front().fitness.reason());
        return front;
    }
    ///@}
};

/// The stage `front`.
inline Front front() { return {}; }

} // namespace ga
