#pragma once

#include "ga/selection/best.hpp"
#include "ga/text/number.hpp"

namespace ga {

/// When a block of generations ends: at the first condition that holds, looked at before every generation. At
/// least one is given: `until({.evaluations = 10000, .fitness = 0.99}, body)`. A run that ends on seconds
/// cannot be repeated bit for bit; every other can.
struct Until {
    std::optional<std::size_t> generations = std::nullopt; ///< this many were made
    std::optional<long> evaluations = std::nullopt;        ///< this many were asked for since the block began
    std::optional<double> seconds = std::nullopt;          ///< this long since the block began
    std::optional<double> fitness = std::nullopt;          ///< the best of the population reaches this
    std::optional<std::size_t> stagnation =
        std::nullopt; ///< this many generations since the best last improved

    /// "generations 20 fitness 0.99"; empty without any condition.
    std::string text() const {
        std::string text;
        const auto add = [&](const char* word, const auto& limit) {
            if (limit)
                text +=
                    std::string(text.empty() ? "" : " ") + word + " " + number(static_cast<double>(*limit));
        };
        add("generations", generations);
        add("evaluations", evaluations);
        add("seconds", seconds);
        add("fitness", fitness);
        add("stagnation", stagnation);
        return text;
    }
};

/// Runs a pipeline again and again on its own answer. Each pass is a generation: its random numbers are its
/// own, and the best at its start are kept where `elite` and `plus` read them.
template <class Body>
struct Generations : Operator {
    Body body;    ///< what each generation runs
    Until end;    ///< when to end
    bool counted; ///< written as `repeat n`

    /// Throws UsageError on an end that never comes, or comes before the first generation.
    Generations(Body body_, Until end_, bool counted_)
        : body(std::move(body_)), end(end_), counted(counted_) {
        if (end.text().empty() || (counted && *end.generations == 0))
            throw UsageError(
                "a block of generations needs an end; expected repeat N with N >= 1, or until with one of "
                "generations, evaluations, seconds, fitness, stagnation");
    }

    /// The block as one step (Block).
    template <Problem P>
    Step<P> step() const {
        using G = typename P::Genome;
        const Stage<P> stages(body);
        const std::string name =
            counted ? "repeat " + std::to_string(*end.generations) : "until " + end.text();
        const std::size_t reads = stages.reads_of_start();
        return {name + " { " + stages.text() + " }",
                [=, end = end](Known& known) {
                    Known inside = known;
                    inside.in_generation = true;
                    if (reads > 0)
                        known.need_score(name);
                    stages.check(inside);
                    if (end.fitness || end.stagnation)
                        inside.need_score(name);
                    stages.check(inside); // what one generation leaves must suit the next
                    known.scored = inside.scored;
                },
                [=, end = end](Population<G> population, Context<P>& context) {
                    return generations(std::move(population), stages, end, reads, context);
                }};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    static Population<G> generations(Population<G> population, const Stage<P>& body, const Until& end,
                                     std::size_t reads, Context<P>& context) {
        typename Context<P>::OpenFrame frame(context, std::move(population));
        const Watch& watch = context.evaluator().watch();
        enum { asked, best, improved }; // the frame's numbers
        if (!frame.resumed())
            frame->numbers = {static_cast<double>(context.counters().asked), -HUGE_VAL, 0};
        const double began = watch.seconds();
        const auto ended = [&] {
            const double reached = best_value(frame->population);
            if (reached > frame->numbers[best]) {
                frame->numbers[best] = reached;
                frame->numbers[improved] = static_cast<double>(frame->next);
            }
            const auto since = [&](int which, auto now) {
                return static_cast<double>(now) - frame->numbers[which];
            };
            return (end.generations && frame->next >= *end.generations) ||
                   (end.evaluations &&
                    since(asked, context.counters().asked) >= static_cast<double>(*end.evaluations)) ||
                   (end.seconds && watch.seconds() - began >= *end.seconds) ||
                   (end.fitness && reached >= *end.fitness) ||
                   (end.stagnation && since(improved, frame->next) >= static_cast<double>(*end.stagnation));
        };
        for (bool inside = frame.resumed(); inside || !ended(); inside = false, ++frame->next) {
            if (!inside)
                frame->kept = {start_of_generation(frame->population, reads)};
            const typename Context<P>::Generation generation(context, frame->next, frame->kept[0]);
            frame->population = body(std::move(frame->population), context);
        }
        if (end.seconds && watch.seconds() - began >= *end.seconds)
            context.note("ended on seconds; another run may end elsewhere");
        return std::move(frame->population);
    }

    /// The best fitness of a scored population; minus infinity where somebody is unscored.
    template <class G>
    static double best_value(const Population<G>& population) {
        double best = -HUGE_VAL;
        for (const auto& individual : population) {
            if (!individual.fitness.known())
                return -HUGE_VAL;
            best = std::max(best, individual.value());
        }
        return best;
    }
};

/// n generations; n >= 1.
template <class Body>
Generations<Body> repeat(std::size_t n, Body body) {
    return {std::move(body), Until{.generations = n}, true};
}
/// The stage `until ... { body }`.
template <class Body>
Generations<Body> until(Until end, Body body) {
    return {std::move(body), end, false};
}

} // namespace ga
