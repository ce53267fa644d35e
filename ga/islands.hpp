#pragma once

#include "ga/selection/best.hpp"

namespace ga {

/// How islands meet: for `rounds` rounds every island runs the body, a generation of its own; after each but
/// the last, copies of its `migrants` best replace as many of the worst on the next island of the ring.
struct Migration {
    std::size_t rounds = 10;  ///< >= 1
    std::size_t migrants = 1; ///< to each neighbour, each round
};

/// Deals the population to n islands (individual i to island i modulo n), lets each evolve by itself under
/// the body, with migration between rounds (Cohoon, Hegde, Martin and Richards 1987), and joins them again.
template <class Body>
struct Islands : Operator {
    std::size_t n;       ///< islands, >= 2
    Migration migration; ///< how they meet
    Body body;           ///< what each runs

    /// Throws UsageError on less than 2 islands or no round.
    Islands(std::size_t count, Migration m, Body b) : n(count), migration(m), body(std::move(b)) {
        if (n < 2 || migration.rounds == 0)
            throw UsageError("islands: " + std::to_string(n) + " islands in " +
                             std::to_string(migration.rounds) +
                             " rounds; expected 2 islands and 1 round at least");
    }

    /// The block as one step (Block).
    template <Problem P>
    Step<P> step() const {
        using G = typename P::Genome;
        const Stage<P> stages(body);
        const std::string name = "islands " + std::to_string(n) +
                                 " rounds=" + std::to_string(migration.rounds) +
                                 " migrants=" + std::to_string(migration.migrants);
        std::vector<Name> names;
        for (std::size_t i = 0; i < n; ++i)
            names.push_back(Name("island" + std::to_string(i + 1)));
        return {name + " { " + stages.text() + " }",
                [=, migration = migration](Known& known) {
                    Known inside = known;
                    inside.in_generation = true;
                    if (stages.reads_of_start() > 0)
                        known.need_score(name);
                    stages.check(inside);
                    if (migration.migrants > 0)
                        inside.need_score(name);
                    stages.check(inside);
                    known.scored = inside.scored;
                },
                [=, migration = migration](Population<G> population, Context<P>& context) {
                    return evolve(std::move(population), stages, names, migration, context);
                }};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    static Population<G> evolve(Population<G> population, const Stage<P>& body,
                                const std::vector<Name>& names, const Migration& migration,
                                Context<P>& context) {
        const std::size_t n = names.size();
        typename Context<P>::OpenFrame frame(context, {});
        if (!frame.resumed()) {
            if (population.size() < n)
                throw NothingLeft(context.path() + ": " + std::to_string(population.size()) +
                                  " individuals for " + std::to_string(n) +
                                  " islands; expected one each at least");
            frame->kept.resize(n + 1); // the islands, and what one's body reads of its start
            for (std::size_t i = 0; i < population.size(); ++i)
                frame->kept[i % n].push_back(std::move(population[i]));
        }
        for (bool inside = frame.resumed(); frame->next < n * migration.rounds;
             inside = false, ++frame->next) {
            const std::size_t island = frame->next % n;
            if (!inside)
                frame->kept[n] = start_of_generation(frame->kept[island], body.reads_of_start());
            const typename Context<P>::Generation generation(context, frame->next / n, frame->kept[n]);
            const typename Context<P>::Scope scope(context, names[island], 0);
            frame->kept[island] = body(std::move(frame->kept[island]), context);
            if (island + 1 == n && frame->next + 1 < n * migration.rounds)
                migrate(frame->kept, n, migration.migrants);
        }
        frame->kept.pop_back();
        Population<G> all;
        for (auto& island : frame->kept)
            for (auto& individual : island)
                all.push_back(std::move(individual));
        return all;
    }

    template <class G>
    static void migrate(std::vector<Population<G>>& islands, std::size_t n, std::size_t migrants) {
        if (migrants == 0)
            return;
        std::vector<Population<G>> leaving;
        for (std::size_t i = 0; i < n; ++i)
            leaving.push_back(best_of(islands[i], migrants));
        for (std::size_t i = 0; i < n; ++i) {
            auto& island = islands[(i + 1) % n];
            const std::vector<std::size_t> order = ranking(island);
            for (std::size_t k = 0; k < std::min(leaving[i].size(), island.size()); ++k)
                island[order[order.size() - 1 - k]] = leaving[i][k];
        }
    }
};

/// @param n  islands, >= 2; the population must have as many individuals
template <class Body>
Islands<Body> islands(std::size_t n, Migration migration, Body body) {
    return {n, migration, std::move(body)};
}

} // namespace ga
