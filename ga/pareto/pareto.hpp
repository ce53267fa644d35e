#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// The volume above the point `reference` that the points dominate (Zitzler and Thiele 1998). Higher is
/// better in every objective. Only points above `reference` in all objectives count. The volume is a sum
/// over the points. Each adds a part to those that are better in the last objective (WFG: While, Bradstreet
/// and Barone 2012). This takes a time of order n log n for n points and two objectives. For each further
/// objective it is at most n times as long, and mostly far less.
double hypervolume(std::vector<Point> points, const Point& reference);

/// The share of a fixed sample of 4096 points that the points dominate. It estimates the hypervolume for many
/// objectives, with less weight far from `reference` (Zitzler, Brockhoff and Thiele 2007). A coordinate of
/// the sample is the reference's plus width u/(1 - u), u uniform in (0, 1).
double dominated_share(const std::vector<Point>& points, const Point& reference, const Point& width);

/// Scores by several objectives at once. Individuals are compared as NSGA-II does (Deb et al. 2002): by the
/// rank of their front, then by crowding. Individuals that violate constraints come last (Deb's rules). Rank
/// and crowding refer to the individuals that a stage compares, so every selection and replacement works:
///
///     pareto({"f1", "f2"})
///         | repeat(250, tournament(2) | cross(sbx()) | mutate(0.03, polynomial()) | pareto({"f1", "f2"}) |
///         plus()) | front()
struct Pareto : Operator {
    std::vector<std::string> objectives;     ///< names of at least two different objectives
    static constexpr bool keeps_size = true; ///< it adds no individual
    /// Throws UsageError on fewer than two objectives, or if one is named twice.
    void validate() const;
    static Words words() {
        return {"pareto", "selection", "scores by several objectives: NSGA-II's rank and crowding"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.objectives, word_list("objectives", "two of the problem's or more"));
    }
    void check(CheckState& known) const;

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
        std::vector<Level> levels;
        for (const auto* objective : read)
            if (std::ranges::count(levels, objective->level) == 0) levels.push_back(objective->level);
        // The objectives of one level are read together; those of the last level complete the fitness.
        std::vector<Point> points(population.size(), Point(read.size()));
        for (const Level level : levels)
            context.visit(
                population, level, [](const auto& individual) { return !individual.fitness.has_failed(); },
                [&](auto& individual, const auto& evaluation) {
                    Point& point = points[static_cast<std::size_t>(&individual - population.data())];
                    Fitness last;
                    for (std::size_t k = 0; k < read.size(); ++k) {
                        if (read[k]->level != level) continue;
                        last = fitness_of(context.problem(), evaluation, *read[k], name);
                        if (last.has_failed()) {
                            individual.fitness = last;
                            return;
                        }
                        point[k] = last.merit();
                    }
                    if (with_first && context.problem().objectives()[0].level == level) {
                        individual.fitness =
                            fitness_of(context.problem(), evaluation, context.problem().objectives()[0], first);
                        context.offer(individual);
                    }
                    if (level == levels.back())
                        individual.fitness = Fitness(name, point).constrained(last.violations());
                });
        return population;
    }
};

/// The stage `pareto objective objective ...`.
Pareto pareto(std::vector<std::string> objectives);

/// Keeps the individuals that no other one dominates.
struct Front : Operator {
    static Words words() {
        return {"front", "selection", "keeps the individuals that no other one dominates, after pareto"};
    }
    void check(CheckState& known) const;

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        auto front = ga::front_of(population);
        if (front.empty())
            context.end_with(population, "every one of " + std::to_string(population.size()) +
                                             " individuals failed; the first: " + population.front().fitness.reason());
        return front;
    }
};

/// The stage `front`.
inline Front front() { return {}; }

} // namespace ga
