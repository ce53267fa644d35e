#pragma once

#include "ga/run/context.hpp"

namespace ga {

/// The n best different genomes of a run under one objective, best first. The first of equal genomes is kept.
/// `checkpoints.keep("hall", hall.members)` stores them with a run.
template <Problem P>
class HallOfFame {
  public:
    using Genome = typename P::Genome; ///< genome of the problem

    /// @param objective  name of an objective of the problem; empty for the first
    HallOfFame(const P& problem, std::size_t n, std::string objective = {})
        : problem_(problem), n_(n), objective_(objective.empty() ? problem.objectives().front().name : objective) {}
    HallOfFame(const HallOfFame&) = delete;

    Population<Genome> members; ///< individuals, best first

    /// The observer for `run`. This hall must outlive the run.
    Observer<Genome> observer() {
        return [this](const Event<Genome>& event) {
            for (const auto& individual : event.population)
                if (!event.derived) offer(individual);
        };
    }
    /// Adds an individual if it has a fitness under the objective and is among the n best.
    void offer(const Individual<Genome>& individual) {
        if (!individual.fitness.known(objective_) || individual.fitness.has_failed()) return;
        if (members.size() == n_ && !better(individual.fitness, members.back().fitness)) return;
        const Fingerprint print = identify(problem_, individual.genome);
        for (const auto& member : members)
            if (identify(problem_, member.genome) == print) return;
        const auto place = std::find_if(members.begin(), members.end(),
                                        [&](const auto& member) { return better(individual.fitness, member.fitness); });
        members.insert(place, individual);
        if (members.size() > n_) members.pop_back();
    }

  private:
    const P& problem_;
    std::size_t n_;
    Name objective_;
};

} // namespace ga
