#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// The exchange of individuals between islands, which form a ring. In each round every island runs the body
/// once, as one generation. After each round except the last, copies of the best individuals of each island
/// replace the worst on the next island.
struct Migration {
    std::size_t rounds = 10;  ///< number of rounds, >= 1
    std::size_t migrants = 1; ///< number of individuals that each island copies to the next one per round
};

/// Splits the population into n islands (individual i goes to island i modulo n). Each island evolves separately under
/// the body, with migration between rounds (Cohoon, Hegde, Martin and Richards 1987). At the end the populations of all
/// islands become one population. Islands run in parallel, and the evaluations of all islands are made together
/// (`Rounds`). Checkpoints are written between two rounds. Evaluations of an unfinished round are not counted twice.
template <class Body>
struct Islands : Operator {
    std::size_t n = 2;   ///< number of islands, 2 to 10,000
    Migration migration; ///< exchange of individuals
    Body body;           ///< pipeline that runs on each island

    static Words words() {
        return {"islands", "blocks",
                "n parts of the population evolve separately, one generation per round, with migrants on a ring"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", std::nullopt, 2, "islands").up_to(10000));
        visit(self.migration.rounds, whole("rounds", 1, "generations of each island").keyed());
        visit(self.migration.migrants,
              whole("migrants", 0, "the best of each island, copied to the next after each round").keyed());
    }

    template <Problem P>
    Stage<P> stage() const {
        using G = typename P::Genome;
        const auto stages = std::make_shared<const Pipeline<P>>(body);
        const std::string name = text_of(*this);
        return {name + " { " + stages->text() + " }",
                [stages, name, n = n, migration = migration](CheckState& known) {
                    known.need_individuals(name, n);
                    const std::size_t at_most = known.at_most;
                    known.at_most = at_most == all_individuals ? at_most : (at_most + n - 1) / n;
                    const bool on_islands = std::exchange(known.on_islands, true);
                    check_generation(*stages, name, known, [&](const CheckState& inside) {
                        if (migration.migrants > 0) inside.need_score(name);
                    });
                    known.on_islands = on_islands;
                },
                [stages, n = n, migration = migration](Population<G> population, Context<P>& context) {
                    return evolve(std::move(population), *stages, n, migration, context);
                }};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static Population<G> evolve(Population<G> population, const Pipeline<P>& body, std::size_t n,
                                              const Migration& migration, Context<P>& context) {
        typename Context<P>::OpenFrame frame(context.state, {});
        if (!frame.resumed()) {
            if (population.size() < n)
                context.end_with(population, std::to_string(population.size()) + " individuals for " +
                                                 std::to_string(n) + " islands; give at least one for each");
            frame->kept.resize(n);
            for (std::size_t i = 0; i < population.size(); ++i) frame->kept[i % n].push_back(std::move(population[i]));
        }
        expect_fit(frame->kept.size() == n && frame->next <= migration.rounds);
        try {
            while (frame->next < migration.rounds) {
                run_round(*frame, body, context);
                if (frame->next + 1 < migration.rounds) migrate(frame->kept, migration.migrants);
                ++frame->next;
                context.pause();
            }
        } catch (const Stopped&) {
            if (!context.state.stopped_population) context.state.stopped_population = joined(frame->kept);
            throw;
        }
        return without_levels(joined(frame->kept));
    }

    /// Runs one generation of every island, each on a separate thread.
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static void run_round(Frame<G>& frame, const Pipeline<P>& body, Context<P>& context) {
        const std::size_t n = frame.kept.size(), depth = context.state.frames.size() - 1;
        Snapshot<G> before;
        context.forget_old();
        if (context.is_kept()) before = context.snapshot();
        std::vector<std::optional<Context<P>>> islands(n);
        std::vector<Frame<G>> loops(n);
        for (std::size_t i = 0; i < n; ++i)
            for (const auto& [path, state] : frame.states)
                if (path.starts_with(context.path() + "/" + name_of(i) + "/")) loops[i].states[path] = state;
        try {
            Rounds<P>::run(
                n, context.queue(), context.ledger().evaluator().threads(),
                [&](std::size_t i, EvaluationQueue<P>& queue) {
                    Context<P>& island = islands[i].emplace(context, queue, i, n);
                    island.state.loops.push_back(&loops[i]);
                    Population<G>& population = frame.kept[i];
                    auto start = start_of_generation(population, body.reads_of_start());
                    const typename Context<P>::Round round(island.position, frame.next, &start);
                    const typename Context<P>::Scope scope(island.position, Name(name_of(i)), 0);
                    try {
                        population = body(std::move(population), island);
                    } catch (const Stopped&) {
                        population = joined_with(start, island.state.stopped_population.value_or(Population<G>()));
                        throw;
                    }
                },
                [&] { context.keep_as(before); });
        } catch (const Stopped&) {
            context.state.stopped_population = joined(frame.kept);
            if (context.is_kept()) {
                frame = *std::next(before.frames.begin(), static_cast<long>(depth));
                context.keep_stopped(before);
            }
            throw;
        }
        for (auto& loop : loops)
            for (auto& [path, state] : loop.states) frame.states[path] = std::move(state);
        const Identity first = context.state.next_identity, step = context.state.identity_step;
        Identity max = 0; // identities that one island has used
        for (std::size_t i = 0; i < n; ++i)
            max = std::max(max, (islands[i]->state.next_identity - first - i * step) / (n * step));
        context.state.next_identity += max * n * step;
        for (auto& each : islands) context.show_again(*each); // an observer may throw Stopped
    }

    static std::string name_of(std::size_t island) { return "island" + std::to_string(island + 1); }

    template <class G>
    static Population<G> joined(const std::vector<Population<G>>& islands) {
        Population<G> all;
        for (const auto& island : islands) all.insert(all.end(), island.begin(), island.end());
        return all;
    }

    template <class G>
    static void migrate(std::vector<Population<G>>& islands, std::size_t migrants) {
        if (migrants == 0) return;
        std::vector<Population<G>> leaving;
        for (const auto& island : islands) leaving.push_back(best_of(island, migrants));
        for (std::size_t i = 0; i < islands.size(); ++i)
            replace_worst(islands[(i + 1) % islands.size()], std::move(leaving[i]));
    }
};

/// The block `islands`.
/// @param n  number of islands, 2 to 10,000; the population must have at least as many individuals
template <class Body>
Islands<Body> islands(std::size_t n, Migration migration, Body body) {
    return checked(Islands<Body>{{}, n, migration, std::move(body)});
}

} // namespace ga
