#pragma once

#include "ga/stage.hpp"

namespace ga {

/// Runs a pipeline n times on the same population, with other random numbers each time, and joins the
/// answers. With `sample` first in the body each time starts afresh.
template <class Body>
struct Restarts : Operator {
    std::size_t n; ///< times, >= 1
    Body body;     ///< what is run each time

    /// Throws UsageError on 0.
    Restarts(std::size_t count, Body b) : n(count), body(std::move(b)) {
        if (n == 0)
            throw UsageError("restarts 0 does nothing; expected at least 1");
    }

    /// The block as one step (Block).
    template <Problem P>
    Step<P> step() const {
        using G = typename P::Genome;
        const Stage<P> stages(body);
        return {"restarts " + std::to_string(n) + " { " + stages.text() + " }",
                [=](Known& known) { stages.check(known); },
                [=, n = n](Population<G> population, Context<P>& context) {
                    typename Context<P>::OpenFrame frame(context, {});
                    if (!frame.resumed())
                        frame->kept = {std::move(population), {}}; // the start, and the answers so far
                    for (; frame->next < n; ++frame->next) {
                        const typename Context<P>::Round round(context, frame->next);
                        for (auto& each : stages(frame->kept[0], context))
                            frame->kept[1].push_back(std::move(each));
                    }
                    return std::move(frame->kept[1]);
                },
                stages.reads_of_start()};
    }
};

/// The stage `restarts n { body }`.
template <class Body>
Restarts<Body> restarts(std::size_t n, Body body) {
    return {n, std::move(body)};
}

} // namespace ga
