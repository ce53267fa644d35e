#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Runs `body` under a problem derived from the run's problem, for example with a coarser grid. Returns the body's
/// population, unscored. The body's evaluations count for the run and its budget. Observers see the body's events,
/// marked as derived. If the run stops inside the body, checkpoints contain the run's state before the stage.
template <Problem P>
PopulationOf<P> run_derived(const Pipeline<P>& body, const P& problem, PopulationOf<P> population,
                            Context<P>& context) {
    Ledger<P>& books = context.ledger();
    Ledger<P> ledger(problem, books.evaluator(), books.memory.bytes(), books.left());
    ledger.counters = books.counters;
    Context<P> inside(context, ledger);
    Frame<typename P::Genome> outermost;
    inside.state.loops.push_back(&outermost);
    const auto unscored = [](PopulationOf<P> all) {
        for (auto& individual : all) individual.fitness = {};
        return all;
    };
    const auto book = [&] {
        books.counters = ledger.counters;
        context.state.next_identity = inside.state.next_identity;
        for (const std::string& note : inside.state.notes) context.state.note(note);
    };
    try {
        population = body(unscored(std::move(population)), inside);
    } catch (...) {
        book();
        throw;
    }
    book();
    return unscored(std::move(population));
}

/// A block whose body runs under derived problems, as one stage. `change(population, body, context)` calls
/// run_derived and returns the block's population, unscored.
template <Problem P, class Change>
Stage<P> derived_stage(const std::string& name, Pipeline<P> body, Change change) {
    using G = typename P::Genome;
    const auto stages = std::make_shared<const Pipeline<P>>(std::move(body));
    Stage<P> stage;
    stage.text = name + " { " + stages->text() + " }";
    stage.check = [stages, name](CheckState& known) {
        if (known.on_islands)
            throw UsageError("stage '" + name + "' cannot run on islands; put it before or after them");
        CheckState inside = known;
        inside.scored.reset();
        stages->check(inside);
        known.scored.reset();
    };
    stage.apply = [stages, change](Population<G> population, Context<P>& context) {
        return change(std::move(population), *stages, context);
    };
    stage.begins = stages->begins();
    return stage;
}

} // namespace ga
