#pragma once

#include "ga/pipeline/stage.hpp"

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
        const auto stages = std::make_shared<const Stage<P>>(body);
        return {"restarts " + std::to_string(n) + " { " + stages->text() + " }",
                [stages](CheckState& known) { stages->check(known); },
                [stages, n = n](Population<G> population, Context<P>& context) {
                    return again(std::move(population), *stages, n, context);
                },
                stages->reads_of_start(), stages->begins()};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static Population<G> again(Population<G> population, const Stage<P>& stages, std::size_t n,
                                             Context<P>& context) {
        typename Context<P>::OpenFrame frame(context.state, {}, true);
        if (!frame.resumed())
            frame->kept = {std::move(population), {}}; // the start, and the answers so far
        expect_fit(frame->kept.size() == 2);
        try {
            for (; frame->next < n; ++frame->next) {
                const typename Context<P>::Round round(context.position, frame->next);
                for (auto& each : stages(frame->kept[0], context))
                    frame->kept[1].push_back(std::move(each));
                frame->states.clear();
                context.need_room(frame->kept[1].size(), {},
                                  frame->kept[1].empty() ? nullptr : &frame->kept[1].front().genome);
            }
        } catch (const Stopped&) {
            auto& in_hand = context.state.in_hand;
            in_hand = joined_with(frame->kept[1], in_hand ? std::move(*in_hand) : Population<G>());
            throw;
        }
        return std::move(frame->kept[1]);
    }
};

/// The stage `restarts n { body }`.
template <class Body>
Restarts<Body> restarts(std::size_t n, Body body) {
    return {n, std::move(body)};
}

} // namespace ga
