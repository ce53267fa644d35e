#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// The volume above the point `reference` that the points dominate (Zitzler and Thiele 1998). Higher is
/// better in every objective. Only points above `reference` in all objectives count. The volume is sliced
/// along one objective after the other (While et al. 2006). This takes a time of order n log n for n points
/// and two objectives, and n times as long for each further objective.
inline double hypervolume(std::vector<Point> points, const Point& reference) {
    const std::size_t last = reference.size() - 1;
    std::erase_if(points, [&](const Point& point) {
        for (std::size_t k = 0; k <= last; ++k)
            if (!(point[k] > reference[k]))
                return true;
        return false;
    });
    const auto order = in_order(
        points.size(), [&](std::size_t a, std::size_t b) { return points[a][last] > points[b][last]; });
    if (points.empty())
        return 0;
    if (last == 0)
        return points[order[0]][0] - reference[0];
    double volume = 0, widest = reference[0];
    std::vector<Point> above;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[order[i]];
        const double next = i + 1 < points.size() ? points[order[i + 1]][last] : reference[last];
        const double thickness = point[last] - next;
        if (last == 1) {
            widest = std::max(widest, point[0]);
            volume += thickness * (widest - reference[0]);
            continue;
        }
        above.push_back(point);
        above.back().pop_back();
        if (thickness > 0)
            volume += thickness * hypervolume(above, Point(reference.begin(), reference.end() - 1));
    }
    return volume;
}

/// The share of a fixed sample of 4096 points that the points dominate. It estimates the hypervolume for many
/// objectives, with less weight far from `reference` (Zitzler, Brockhoff and Thiele 2007). A coordinate of
/// the sample is the reference's plus width u/(1 - u), u uniform in (0, 1).
inline double dominated_share(const std::vector<Point>& points, const Point& reference, const Point& width) {
    constexpr int count = 4096;
    Stream stream(reference.size());
    int dominated = 0;
    Point sample(reference.size());
    for (int i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < sample.size(); ++k) {
            const double u = stream.uniform();
            sample[k] = reference[k] + width[k] * u / (1 - u);
        }
        dominated += std::any_of(points.begin(), points.end(), [&](const Point& point) {
            for (std::size_t k = 0; k < sample.size(); ++k)
                if (!(point[k] >= sample[k]))
                    return false;
            return true;
        });
    }
    return static_cast<double>(dominated) / count;
}

/// Scores by several objectives at once. Individuals are compared as NSGA-II does (Deb et al. 2002): by the
/// rank of their front, then by crowding. Individuals that violate constraints come last (Deb's rules). Rank
/// and crowding refer to the individuals that a stage compares, so every selection and replacement works:
///
///     pareto({"f1", "f2"})
///         | repeat(250, tournament(2) | cross(sbx()) | mutate(0.03, polynomial()) | pareto({"f1", "f2"}) |
///         plus()) | front()
struct Pareto : Operator {
    std::vector<std::string> objectives; ///< names of at least two different objectives
    /// Throws UsageError on fewer than two objectives, or if one is named twice.
    [[gnu::cold]] void validate() const {
        if (objectives.size() < 2)
            throw UsageError("pareto compares " + std::to_string(objectives.size()) +
                             " objectives; give the names of 2 or more");
        for (auto each = objectives.begin(); each != objectives.end(); ++each)
            if (std::find(objectives.begin(), each, *each) != each)
                throw UsageError("pareto is given '" + *each + "' twice; give different objectives");
    }
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
        std::vector<Level> levels;
        for (const auto* objective : read)
            if (std::ranges::count(levels, objective->level) == 0)
                levels.push_back(objective->level);
        // The objectives of one level are read together; those of the last level complete the fitness.
        std::vector<Point> points(population.size(), Point(read.size()));
        for (const Level level : levels)
            context.visit(
                population, level, [](const auto& individual) { return !individual.fitness.has_failed(); },
                [&](auto& individual, const auto& evaluation) {
                    Point& point = points[static_cast<std::size_t>(&individual - population.data())];
                    Fitness last;
                    for (std::size_t k = 0; k < read.size(); ++k) {
                        if (read[k]->level != level)
                            continue;
                        last = fitness_of(context.problem(), evaluation, *read[k], name);
                        if (last.has_failed()) {
                            individual.fitness = last;
                            return;
                        }
                        point[k] = last.merit();
                    }
                    if (with_first && context.problem().objectives()[0].level == level) {
                        individual.fitness = fitness_of(context.problem(), evaluation,
                                                        context.problem().objectives()[0], first);
                        context.offer(individual);
                    }
                    if (level == levels.back())
                        individual.fitness = Fitness(name, point).constrained(last.violations());
                });
        return population;
    }
};

/// The stage `pareto objective objective ...`.
inline Pareto pareto(std::vector<std::string> objectives) {
    return checked(Pareto{{}, std::move(objectives)});
}

/// Keeps the individuals that no other one dominates.
struct Front : Operator {
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
};

/// The stage `front`.
inline Front front() { return {}; }

} // namespace ga
