#pragma once

#include "ga/variation/distance.hpp"

namespace ga {

/// Brings back the k best individuals of the generation's start that the population lacks, in place of worse
/// ones. Under several objectives both populations are first ranked together.
struct Elite : Operator {
    std::size_t k = 1; ///< number of individuals that come back, >= 1
    static Words words() {
        return {"elite", "replacement", "brings back the k best of the generation's start for the worst"};
    }
    static void describe(auto& self, auto visit) { visit(self.k, whole("k", 1, "how many")); }
    std::size_t reads_of_start() const { return k; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        const std::size_t n = population.size();
        std::vector<double> worth = merits(population, start);
        for (std::size_t i = 0; i < std::min(k, start.size()); ++i) {
            if (std::ranges::count(population, start[i].identity, &Individual<typename P::Genome>::identity)) continue;
            const auto worst = std::ranges::min_element(std::span(worth).first(n));
            if (*worst < worth[n + i]) {
                *worst = worth[n + i];
                population[static_cast<std::size_t>(&*worst - worth.data())] = start[i];
            }
        }
        return population;
    }
};

/// (mu + lambda) replacement (Schwefel 1975). Returns the mu best individuals of the generation's start and
/// of the population, ranked as one: under several objectives NSGA-II's replacement (Deb et al. 2002). With
/// `copies=none`, individuals with equal genomes stay only if there are fewer than mu different genomes.
struct Plus : Operator {
    std::size_t mu = 0;         ///< number of individuals that stay; 0 for the size of the generation's start
    std::string copies = "any"; ///< whether genomes may be equal: any or none
    static Words words() { return {"plus", "replacement", "the mu best of the generation's start and its children"}; }
    static void describe(auto& self, auto visit) {
        visit(self.mu, whole("mu", 0, "how many; 0 for as many as at the start").quiet());
        visit(self.copies, word("copies", "any, or none: keeps different genomes").keyed().quiet());
    }
    void validate() const {
        if (copies != "any" && copies != "none")
            throw UsageError("stage 'plus': copies is '" + copies + "'; use any or none");
    }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        const std::size_t n = mu > 0 ? mu : start.size();
        population = joined_with(start, std::move(population));
        if (copies == "any") return best_of(population, n);
        const auto left = take_copies(population, context.problem());
        population = best_of(population, n);
        std::ranges::move(best_of(left, n - population.size()), std::back_inserter(population));
        return population;
    }
};

/// Removes individuals whose genome equals that of an earlier individual. With a distance, removes individuals within
/// this distance of an earlier one that stays. Put `best n` before this stage to keep the better ones.
struct Distinct : Operator {
    double distance = 0; ///< distance, 0 or more; see ga::distance
    static Words words() { return {"distinct", "selection", "removes individuals that equal an earlier one"}; }
    static void describe(auto& self, auto visit) {
        visit(self.distance, number("distance", 0, no_limit,
                                    "removes those this near, too: rms of genes in widths, or share that differs")
                                 .quiet());
    }
    void check(CheckState&) const {}

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        take_copies(population, context.problem());
        if (distance == 0) return population;
        if constexpr (HasDistance<P>) {
            PopulationOf<P> left;
            for (auto& each : population)
                if (std::ranges::none_of(left, [&](const auto& other) {
                        return ga::distance(context.problem(), other.genome, each.genome) <= distance;
                    }))
                    left.push_back(std::move(each));
            return left;
        } else {
            throw UsageError("stage '" + text_of(*this) + "' needs a distance; use a problem that has " + no_distance);
        }
    }
};

/// Adds the individuals of the generation's start, so that the next stages choose among both populations.
struct JoinParents : Operator {
    static Words words() {
        return {"parents", "replacement", "adds the generation's start, so that the next stages choose among all"};
    }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const {
        known.need_generation(text_of(*this));
        if (known.scored != known.start_scored) known.scored.reset();
    }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        context.need_room(population.size() + start.size(), population);
        return joined_with(start, std::move(population));
    }
};

/// Steady-state replacement (Whitley 1989): the generation's start, with its worst individuals replaced by
/// the children, whatever the children's fitness. For two children per generation, put `tournament 2 size=2`
/// before this stage.
struct Steady : Operator {
    static Words words() {
        return {"steady", "replacement", "the generation's start with its worst replaced by the children"};
    }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> children, Context<P>& context) const {
        auto population = context.generation_start();
        replace_worst(population, std::move(children));
        return population;
    }
};

///@{ The operators as stages.
inline Elite elite(std::size_t k) { return checked(Elite{{}, k}); }
inline Plus plus(std::size_t mu = 0, std::string copies = "any") { return checked(Plus{{}, mu, std::move(copies)}); }
inline Distinct distinct(double distance = 0) { return checked(Distinct{{}, distance}); }
inline JoinParents parents() { return {}; }
inline Steady steady() { return {}; }
///@}

} // namespace ga
