#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// How islands meet: for `rounds` rounds every island runs the body, a generation of its own; after each but
/// the last, copies of its `migrants` best replace as many of the worst on the next island of the ring.
struct Migration {
    std::size_t rounds = 10;  ///< >= 1
    std::size_t migrants = 1; ///< to each neighbour, each round
};

/// Deals the population to n islands (individual i to island i modulo n), lets each evolve by itself under
/// the body, with migration between rounds (Cohoon, Hegde, Martin and Richards 1987), and joins them again.
/// Islands run side by side and what they ask is evaluated together (`Rounds`). A run is kept between two
/// rounds; what an unfinished round has paid for is not paid again.
template <class Body>
struct Islands : Operator {
    static constexpr std::size_t most = 10000; ///< islands

    std::size_t n;       ///< islands, 2 to 10,000
    Migration migration; ///< how they meet
    Body body;           ///< what each runs

    /// Throws UsageError on less than 2 islands, more than 10,000, or no round.
    Islands(std::size_t count, Migration m, Body b) : n(count), migration(m), body(std::move(b)) {
        if (n < 2 || n > most || migration.rounds == 0)
            throw UsageError("islands: " + std::to_string(n) + " islands in " +
                             std::to_string(migration.rounds) +
                             " rounds; expected 2 to 10000 islands and 1 round at least");
    }

    /// The block as one step (Block).
    template <Problem P>
    Step<P> step() const {
        using G = typename P::Genome;
        const auto stages = std::make_shared<const Stage<P>>(body);
        const std::string name = "islands " + std::to_string(n) +
                                 " rounds=" + std::to_string(migration.rounds) +
                                 " migrants=" + std::to_string(migration.migrants);
        return {name + " { " + stages->text() + " }",
                [stages, name, migration = migration](CheckState& known) {
                    const bool on_islands = std::exchange(known.on_islands, true);
                    check_generation(*stages, name, known, [&](const CheckState& inside) {
                        if (migration.migrants > 0)
                            inside.need_score(name);
                    });
                    known.on_islands = on_islands;
                },
                [stages, n = n, migration = migration](Population<G> population, Context<P>& context) {
                    return evolve(std::move(population), *stages, n, migration, context);
                }};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static Population<G> evolve(Population<G> population, const Stage<P>& body, std::size_t n,
                                              const Migration& migration, Context<P>& context) {
        typename Context<P>::OpenFrame frame(context.state, {});
        if (!frame.resumed()) {
            if (population.size() < n)
                throw NothingLeft(context.path() + ": " + std::to_string(population.size()) +
                                  " individuals for " + std::to_string(n) +
                                  " islands; expected one each at least");
            frame->kept.resize(n);
            for (std::size_t i = 0; i < population.size(); ++i)
                frame->kept[i % n].push_back(std::move(population[i]));
        }
        expect_fit(frame->kept.size() == n && frame->next <= migration.rounds);
        while (frame->next < migration.rounds) {
            run_round(*frame, body, context);
            if (frame->next + 1 < migration.rounds)
                migrate(frame->kept, migration.migrants);
            ++frame->next;
            try {
                context.pause();
            } catch (const Stopped&) {
                context.state.in_hand = joined(frame->kept);
                throw;
            }
        }
        return strict(joined(frame->kept));
    }

    /// One generation of every island, each on a thread of its own.
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static void run_round(Frame<G>& frame, const Stage<P>& body, Context<P>& context) {
        const std::size_t n = frame.kept.size(), depth = context.state.frames.size() - 1;
        Snapshot<G> before;
        context.forget_old();
        if (context.is_kept())
            before = context.snapshot();
        std::vector<std::optional<Context<P>>> islands(n);
        std::vector<Frame<G>> loops(n);
        for (std::size_t i = 0; i < n; ++i)
            for (const auto& [path, state] : frame.states)
                if (path.starts_with(context.path() + "/" + name_of(i) + "/"))
                    loops[i].states[path] = state;
        try {
            Rounds<P>::run(
                n, context.door(),
                [&](std::size_t i, EvaluationQueue<P>& door) {
                    Context<P>& own = islands[i].emplace(context, door, i, n);
                    own.state.loops.push_back(&loops[i]);
                    Population<G>& population = frame.kept[i];
                    auto start = start_of_generation(population, body.reads_of_start());
                    const typename Context<P>::Generation generation(own.position, frame.next, start);
                    const typename Context<P>::Scope scope(own.position, Name(name_of(i)), 0);
                    try {
                        population = body(std::move(population), own);
                    } catch (const Stopped&) {
                        population =
                            joined_with(start, own.state.in_hand ? *own.state.in_hand : Population<G>());
                        throw;
                    }
                },
                [&] { context.keep_as(before); });
        } catch (const Stopped&) {
            context.state.in_hand = joined(frame.kept);
            if (context.is_kept()) {
                frame = *std::next(before.frames.begin(), static_cast<long>(depth));
                context.keep_stopped(before);
            }
            throw;
        }
        for (auto& loop : loops)
            for (auto& [path, state] : loop.states)
                frame.states[path] = std::move(state);
        Identity given = 0; // at most, by one island
        for (std::size_t i = 0; i < n; ++i)
            given = std::max(given, (islands[i]->state.next_identity - context.state.next_identity -
                                     i * context.state.identity_step) /
                                        islands[i]->state.identity_step);
        context.state.next_identity += given * n * context.state.identity_step;
        try {
            for (auto& island : islands)
                context.show_again(*island);
        } catch (const Stopped&) { // an observer has seen enough
            context.state.in_hand = joined(frame.kept);
            throw;
        }
    }

    static std::string name_of(std::size_t island) { return "island" + std::to_string(island + 1); }

    template <class G>
    static Population<G> joined(const std::vector<Population<G>>& islands) {
        Population<G> all;
        for (const auto& island : islands)
            all.insert(all.end(), island.begin(), island.end());
        return all;
    }

    template <class G>
    static void migrate(std::vector<Population<G>>& islands, std::size_t migrants) {
        const std::size_t n = islands.size();
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

/// @param n  islands, 2 to 10,000; the population must have as many individuals
template <class Body>
Islands<Body> islands(std::size_t n, Migration migration, Body body) {
    return {n, migration, std::move(body)};
}

} // namespace ga
