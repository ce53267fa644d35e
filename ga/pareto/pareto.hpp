#pragma once

#include "ga/pareto/ranking.hpp"
#include "ga/stage.hpp"

namespace ga {

/// Scores by several objectives at once, as NSGA-II does (Deb et al. 2002): fitness = -rank + c/(2(1 + c))
/// with the rank of the individual's front in this population, from 0, and its crowding distance c. Its order
/// is NSGA-II's crowded comparison, so every selection serves; the front is where fitness is 0 or more.
/// Failed individuals rank last.
///
///     pareto({"f1", "f2"})
///         | repeat(250, tournament(2) | cross(sbx()) | mutate(0.03, polynomial()) | parents()
///                           | pareto({"f1", "f2"}) | best(100)) | front()
struct Pareto : Operator {
    std::vector<std::string> objectives; ///< names, two at least

    /// Throws UsageError on less than two.
    explicit Pareto(std::vector<std::string> names) : objectives(std::move(names)) {
        if (objectives.size() < 2)
            throw UsageError("pareto compares " + std::to_string(objectives.size()) +
                             " objectives; expected the names of 2 at least");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const {
        std::string text = "pareto";
        for (const auto& objective : objectives)
            text += " " + objective;
        return text;
    }
    void check(Known& known) const {
        for (const auto& objective : objectives)
            known.objective(text(), objective);
        known.scored = "pareto";
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        std::vector<const Objective<typename P::Outcome>*> read;
        for (const auto& objective : objectives)
            read.push_back(&context.problem().objectives()[context.objective_index(objective)]);
        const Name name("pareto");
        std::vector<Point> points;
        std::vector<Individual<typename P::Genome>*> ranked;
        context.evaluate(population, [&](auto& individual, const auto& evaluation) {
            Point point;
            Fitness fitness;
            for (const auto* objective : read) {
                fitness = Evaluator<P>::judge(evaluation, *objective, name);
                if (fitness.has_failed())
                    break;
                point.push_back(fitness.value());
            }
            individual.fitness = fitness;
            if (fitness.has_failed())
                return false;
            points.push_back(std::move(point));
            ranked.push_back(&individual);
            return true;
        });
        const std::vector<std::size_t> ranks = pareto_ranks(points);
        const std::vector<double> room = crowding_distances(points, ranks);
        for (std::size_t i = 0; i < ranked.size(); ++i) {
            const double bonus = std::isfinite(room[i]) ? room[i] / (2 * (1 + room[i])) : 0.5;
            ranked[i]->fitness = Fitness(name, -static_cast<double>(ranks[i]) + bonus);
        }
        return population;
    }
    ///@}
};

/// The stage `pareto objective objective ...`.
inline Pareto pareto(std::vector<std::string> objectives) { return Pareto(std::move(objectives)); }

/// Keeps the individuals that no other dominates.
struct Front : Operator {
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "front"; }
    void check(Known& known) const {
        if (known.scored != "pareto")
            throw UsageError("stage 'front' needs a population ranked by pareto; expected pareto before it");
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population, Context<P>&) const {
        std::erase_if(population, [](const auto& individual) { return individual.value() < 0; });
        return population;
    }
    ///@}
};

/// The stage `front`.
inline Front front() { return {}; }

} // namespace ga
