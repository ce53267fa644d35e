#pragma once

#include "ga/pipeline/stage.hpp"
#include "ga/stopping/until.hpp"

namespace ga {

/// The step of a block of generations, whatever it was written as.
template <Problem P, class G = typename P::Genome>
class GenerationsStep {
  public:
    /// Throws UsageError on an end that never comes, or comes before the first generation.
    [[gnu::cold]] static Step<P> of(Stage<P> body, std::vector<Rule<G>> rules, bool counted) {
        std::string name = "until";
        for (const Rule<G>& rule : rules)
            name += " " + rule.text;
        if (counted)
            name = "repeat" + rules.front().text.substr(rules.front().text.find(' '));
        if (rules.empty() || name == "repeat 0")
            throw UsageError(
                "a block of generations needs an end; expected repeat N with N >= 1, or until with "
                "one of generations, evaluations, seconds, fitness, stagnation, converged");
        const auto block = std::make_shared<const GenerationsStep>(std::move(body), std::move(rules), name);
        Step<P> step;
        step.text = name + " { " + block->body_.text() + " }";
        step.check = [block](CheckState& known) { block->check(known); };
        step.apply = [block](Population<G> population, Context<P>& context) {
            return block->run(std::move(population), context);
        };
        step.begins = block->body_.begins();
        return step;
    }

    /// Use `of`.
    GenerationsStep(Stage<P> body, std::vector<Rule<G>> rules, std::string name)
        : body_(std::move(body)), rules_(std::move(rules)), name_(std::move(name)),
          reads_(body_.reads_of_start()) {}

  private:
    [[gnu::cold]] void check(CheckState& known) const {
        check_generation(body_, name_, known, [&](const CheckState& inside) {
            for (const Rule<G>& rule : rules_)
                if (rule.check)
                    rule.check(inside, name_);
        });
    }

    Population<G> run(Population<G> population, Context<P>& context) const {
        typename Context<P>::OpenFrame frame(context.state, std::move(population), true);
        enum { asked, seconds, asked_last, moved }; // the block's own numbers
        auto& numbers = frame->numbers;             // its own, what it knows of improvement, and each rule's
        if (!frame.resumed()) {
            numbers.resize(2 + rules_.size());
            const auto began = static_cast<double>(context.counters().asked);
            numbers[0] = {began, context.seconds(), began, 0};
        }
        expect_fit(numbers.size() == 2 + rules_.size() && numbers[0].size() == 4 &&
                   (!frame.resumed() || frame->kept.size() == 1));
        bool sure = false, paying = false;
        for (const Rule<G>& rule : rules_) {
            sure |= rule.sure;
            paying |= rule.text.starts_with(AfterEvaluations::words().name);
        }
        const auto ended = [&] {
            const Progress<G> now{frame->next,
                                  context.counters().asked - static_cast<long>(numbers[0][asked]),
                                  context.seconds() - numbers[0][seconds], frame->population};
            bool end = false;
            for (std::size_t i = 0; i < rules_.size(); ++i)
                if (rules_[i].holds(now, numbers[2 + i])) {
                    end = true;
                    if (rules_[i].text.starts_with(AfterSeconds::words().name))
                        context.note("ended on seconds; another run may end elsewhere");
                }
            return end || (!sure && idle(now, numbers[0], numbers[1], paying, context));
        };
        try {
            for (bool inside = frame.resumed(); inside || !ended(); inside = false, ++frame->next) {
                if (!inside)
                    frame->kept = {start_of_generation(frame->population, reads_)};
                const typename Context<P>::Generation generation(context.position, frame->next,
                                                                 frame->kept[0]);
                frame->population = body_(std::move(frame->population), context);
            }
        } catch (const Stopped&) {
            auto& in_hand = context.state.in_hand;
            if (in_hand && !frame->kept.empty())
                in_hand = joined_with(frame->kept[0], std::move(*in_hand));
            throw;
        }
        return strict(std::move(frame->population));
    }

    /// Whether nothing has moved for so long that nothing will; evaluations move what waits for them
    /// (`paying`).
    static bool idle(const Progress<G>& now, Numbers& own, Numbers& improvement, bool paying,
                     Context<P>& context) {
        constexpr double patience = 10000; // generations
        enum { asked, seconds, asked_last, moved };
        const auto asked_now = static_cast<double>(context.counters().asked);
        if (improves(now, improvement) || (paying && asked_now > own[asked_last]))
            own[moved] = static_cast<double>(now.generation);
        own[asked_last] = asked_now;
        if (static_cast<double>(now.generation) - own[moved] < patience)
            return false;
        context.note("ended after 10000 generations that brought it no nearer to its end");
        return true;
    }

    Stage<P> body_;
    std::vector<Rule<G>> rules_;
    std::string name_;
    std::size_t reads_;
};

/// Runs a pipeline again and again on its own answer. Each pass is a generation: its random numbers are its
/// own, and the best at its start are kept where `elite` and `plus` read them. Where no rule is sure to hold
/// some day, the block ends after 10,000 generations that bettered nothing (and asked for nothing, where it
/// ends on evaluations).
template <class Body, class Ends>
struct Generations : Operator {
    Body body;    ///< what each generation runs
    Ends ends;    ///< when to end
    bool counted; ///< written as `repeat n`

    /// The block `until ends { body }`.
    Generations(Body body_, Ends ends_, bool counted_ = false)
        : body(std::move(body_)), ends(std::move(ends_)), counted(counted_) {}

    /// The block as one step (Block). Throws UsageError on an end that never comes, or comes before the first
    /// generation.
    template <Problem P>
    Step<P> step() const {
        return GenerationsStep<P>::of(body, ends.template rules<typename P::Genome>(), counted);
    }
};

/// n generations; n >= 1.
template <class Body>
Generations<Body, Until> repeat(std::size_t n, Body body) {
    return {std::move(body), Until{.generations = n}, true};
}
/// The stage `until ... { body }` by the engine's own rules. Throws UsageError where none is given.
template <class Body>
Generations<Body, Until> until(Until end, Body body) {
    if (!(end.generations || end.evaluations || end.seconds || end.fitness || end.stagnation ||
          end.converged))
        throw UsageError("until has no end; expected one of generations, evaluations, seconds, fitness, "
                         "stagnation, converged");
    return {std::move(body), end};
}
/// The stage `until ... { body }` by rules of any kind.
template <class Body, class First, class... R>
Generations<Body, AnyOf<First, R...>> until(AnyOf<First, R...> ends, Body body) {
    return {std::move(body), std::move(ends)};
}
/// The stage `until ... { body }` by one rule of any kind.
template <class Body, class R>
requires std::derived_from<R, StoppingRule> Generations<Body, AnyOf<R>> until(R rule, Body body) {
    return {std::move(body), any_of(std::move(rule))};
}

} // namespace ga
