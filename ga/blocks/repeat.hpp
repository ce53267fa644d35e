#pragma once

#include "ga/stopping/rules.hpp"

namespace ga {

constexpr double max_idle_generations = 10000; ///< generations without progress after which a block ends

/// Runs the body of a block of generations until the first rule holds.
template <Problem P, class G = typename P::Genome>
Population<G> run_generations(const Pipeline<P>& body, const std::vector<Rule<G>>& rules, Population<G> population,
                              Context<P>& context) {
    typename Context<P>::OpenFrame frame(context.state, std::move(population), true);
    const double& price = context.counters().requested_price;
    auto& numbers = frame->numbers; // the block's, those of `improves`, then each rule's
    if (!frame.resumed()) {
        numbers = {{price, context.seconds(), price, 0, price}};
        numbers.resize(2 + rules.size());
    }
    expect_fit(numbers.size() == 2 + rules.size() && numbers[0].size() == 5 &&
               (!frame.resumed() || frame->kept.size() == 1));
    const double first_price = numbers[0][0], first_seconds = numbers[0][1];
    double &price_at_check = numbers[0][2], &last_progress = numbers[0][3], &price_of_generations = numbers[0][4];
    const auto paying = [](const Rule<G>& rule) { return rule.text.starts_with(AfterEvaluations::words().name); };
    // Progress is an improvement, or with the rule `evaluations` a requested evaluation.
    const auto idle = [&](const BlockProgress<G>& now) {
        const bool paid = price > std::exchange(price_at_check, price);
        const auto generation = static_cast<double>(now.generation);
        if (improves(now, numbers[1]) || (paid && std::ranges::any_of(rules, paying))) last_progress = generation;
        return generation - last_progress >= max_idle_generations;
    };
    const auto ended = [&] {
        const BlockProgress<G> now{frame->next, price - first_price, context.seconds() - first_seconds,
                                   frame->population};
        bool end = false;
        for (std::size_t i = 0; i < rules.size(); ++i)
            if (rules[i].holds(now, numbers[2 + i])) {
                end = true;
                if (rules[i].text.starts_with(AfterSeconds::words().name))
                    context.note("ended after its seconds; another run may end in another generation");
            }
        if (end) return true;
        // idle generations of all blocks are counted, so that blocks inside each other do not multiply them
        end = (frame->next > 0 && context.state.idle_generations >= max_idle_generations) ||
              (std::ranges::none_of(rules, &Rule<G>::sure) && idle(now));
        if (end) context.note("ended after 10000 generations without progress towards its end");
        return end;
    };
    try {
        for (bool inside = frame.resumed(); inside || !ended(); inside = false, ++frame->next) {
            if (!inside) frame->kept = {start_of_generation(frame->population, body.reads_of_start())};
            const typename Context<P>::Round round(context.position, frame->next, &frame->kept[0]);
            frame->population = body(std::move(frame->population), context);
            double& idle_generations = context.state.idle_generations;
            idle_generations = price > std::exchange(price_of_generations, price) ? 0 : idle_generations + 1;
        }
    } catch (const Stopped&) {
        auto& stopped = context.state.stopped_population;
        if (stopped && !frame->kept.empty()) stopped = joined_with(frame->kept[0], std::move(*stopped));
        throw;
    }
    return without_levels(std::move(frame->population));
}

/// A block of generations as one stage; `name` is its text in front of the braces.
template <Problem P, class G = typename P::Genome>
[[gnu::cold]] Stage<P> generations_stage(const std::string& name, Pipeline<P> body, const std::vector<Rule<G>>& rules) {
    const auto stages = std::make_shared<const Pipeline<P>>(std::move(body)); // so that copies of blocks are cheap
    return {name + " { " + stages->text() + " }",
            [=](CheckState& known) {
                check_generation(*stages, name, known, [&](const CheckState& inside) {
                    for (const Rule<G>& rule : rules) rule.check(inside, name);
                });
            },
            [=](Population<G> population, Context<P>& context) {
                return run_generations(*stages, rules, std::move(population), context);
            },
            0, stages->begins()};
}

/// Runs a body n times, each time on the previous result. Each time is a generation, with different random numbers.
/// After 10,000 generations without a requested evaluation the block ends with a note, like every block of generations.
template <class Body>
struct Repeat : Operator {
    std::size_t n = 1; ///< number of generations, >= 1
    Body body;         ///< pipeline that runs in each generation

    static Words words() { return {"repeat", "blocks", "n generations of the pipeline in braces"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }

    template <Problem P>
    Stage<P> stage() const {
        return generations_stage<P>(text_of(*this), body, {rule_of<typename P::Genome>(AfterGenerations{{}, n})});
    }
};
/// The block `repeat n { body }`; n >= 1.
template <class Body>
Repeat<Body> repeat(std::size_t n, Body body) {
    return checked(Repeat<Body>{{}, n, std::move(body)});
}

/// The block `until rules { body }` as one stage. Throws UsageError without a rule.
template <Problem P, class G = typename P::Genome>
[[gnu::cold]] Stage<P> until_stage(const Pipeline<P>& body, const std::vector<Rule<G>>& rules) {
    std::string name = "until";
    for (const Rule<G>& rule : rules) name += " " + rule.text;
    if (rules.empty())
        throw UsageError("until has no end; give one of generations, evaluations, seconds, fitness, "
                         "stagnation, converged");
    return generations_stage<P>(name, body, rules);
}

/// Runs a body in generations, like Repeat, until a rule holds. If no rule is certain to hold, the block also
/// ends after 10,000 generations without an improvement. With the rule `evaluations`, these generations must
/// also be without a requested evaluation.
template <class Body, class Ends>
struct Generations : Operator {
    Body body; ///< pipeline that runs in each generation
    Ends ends; ///< rules that end the block

    /// The block as one stage (Operator). Throws UsageError if it has no rule.
    template <Problem P>
    Stage<P> stage() const {
        return until_stage<P>(body, ends.template rules<typename P::Genome>());
    }
};

/// The block `until ... { body }` with the engine's rules (Until) or any rules (any_of()).
template <class Body, class Ends = Until>
Generations<Body, Ends> until(Ends ends, Body body) {
    return {{}, std::move(body), std::move(ends)};
}
/// The block `until ... { body }` with any one rule.
template <class Body, class R>
requires std::derived_from<R, StoppingRule> Generations<Body, AnyOf<R>> until(R rule, Body body) {
    return {{}, std::move(body), any_of(std::move(rule))};
}

/// Runs a body n times on the same population, with different random numbers each time. Returns the
/// individuals of all results. If the body begins with `sample`, each run has a new population.
template <class Body>
struct Restarts : Operator {
    std::size_t n = 1; ///< number of runs, >= 1
    Body body;         ///< pipeline that runs each time

    static Words words() {
        return {"restarts", "blocks", "runs the pipeline n times on the same population and joins the answers"};
    }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }

    template <Problem P>
    Stage<P> stage() const {
        const auto stages = std::make_shared<const Pipeline<P>>(body);
        return {text_of(*this) + " { " + stages->text() + " }", [stages](CheckState& known) { stages->check(known); },
                [stages, n = n](PopulationOf<P> population, Context<P>& context) {
                    return run_all(std::move(population), *stages, n, context);
                },
                stages->reads_of_start(), stages->begins()};
    }

  private:
    template <Problem P, class G = typename P::Genome>
    [[gnu::cold]] static Population<G> run_all(Population<G> population, const Pipeline<P>& stages, std::size_t n,
                                               Context<P>& context) {
        typename Context<P>::OpenFrame frame(context.state, {}, true);
        if (!frame.resumed()) frame->kept = {std::move(population), {}}; // the start, and the results so far
        expect_fit(frame->kept.size() == 2);
        Population<G>& answers = frame->kept[1];
        try {
            for (; frame->next < n; ++frame->next) {
                const typename Context<P>::Round round(context.position, frame->next);
                for (auto& each : stages(frame->kept[0], context)) answers.push_back(std::move(each));
                frame->states.clear();
                context.need_room(answers.size(), {}, answers.empty() ? nullptr : &answers.front().genome);
            }
        } catch (const Stopped&) {
            auto& stopped = context.state.stopped_population;
            stopped = joined_with(answers, stopped.value_or(Population<G>()));
            throw;
        }
        return std::move(answers);
    }
};

/// The block `restarts n { body }`; n >= 1.
template <class Body>
Restarts<Body> restarts(std::size_t n, Body body) {
    return checked(Restarts<Body>{{}, n, std::move(body)});
}

} // namespace ga
