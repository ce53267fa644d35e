#pragma once

#include "ga/pipeline/check.hpp"
#include "ga/pipeline/parameters.hpp"
#include "ga/run/context.hpp"

namespace ga {

/// One operator for one type of problem: its text ("best 3"; the first word is its name), what it needs, what
/// it does.
template <Problem P>
struct Step {
    using Genome = typename P::Genome;      ///< of the problem
    std::string text;                       ///< as pipelines write it
    std::function<void(CheckState&)> check; ///< what it needs and makes known
    std::function<Population<Genome>(Population<Genome>, Context<P>&)> apply; ///< what it does
    std::size_t reads_of_start = 0; ///< how many of the best at the start of its generation it reads
    bool begins = false;            ///< it makes a population of nothing
};

// clang-format off
/// An operator is a small struct with
/// @code
///     words() and describe()                              from which its text follows (parameters.hpp), or text()
///     void check(CheckState&) const;                           what it needs and makes known
///     Population operator()(Population, Context<P>&) const;   a template over the problem P, constrained by
///                                                         what it uses
/// @endcode
/// deriving from this tag, which gives it `|`. Besides, it may have
/// @code
///     struct State;                           what it carries from one generation to the next, written and read
///                                             by to_json and from_json; the call takes a State& at its end
///     std::size_t reads_of_start() const;     how many of the best at its generation's start it reads; everyone
///     static constexpr bool begins = true;    where it makes a population of nothing
///     template <Problem P> void check_problem() const;   what no concept can tell of a problem
/// @endcode
// clang-format on
struct Operator {};

/// An operator as it is. Throws UsageError on values that it does not allow.
template <class Op>
requires std::derived_from<Op, Operator>
[[gnu::cold]] Op checked(Op op) {
    if constexpr (requires { op.validate(); })
        op.validate();
    else
        check_values(op, Op::words().name);
    return op;
}

/// An operator that holds pipelines gives, in place of the call, `template <Problem P> Step<P> step() const`.
template <class Op, class P>
concept Block = requires(const Op& op) {
    op.template step<P>();
};

/// What an operator is as text: its own words, or those that follow from its parameters.
template <class Op>
std::string stage_text(const Op& op) {
    if constexpr (requires { op.text(); })
        return op.text();
    else
        return text_of(op);
}

/// a | b before the problem is known.
template <class A, class B>
struct Then : Operator {
    A first;  ///< goes first
    B second; ///< takes its answer
    /// a | b.
    Then(A a, B b) : first(std::move(a)), second(std::move(b)) {}
};

/// A pipeline: Population -> Population through a list of operators. `|` joins lists, so grouping never
/// matters.
template <Problem P>
class Stage {
  public:
    using Genome = typename P::Genome; ///< of the problem

    Stage() = default;
    /// An operator as a pipeline of one stage, or operators joined by `|` before the problem was known.
    /// Throws UsageError where the problem lacks what they need; what concepts can tell is refused when it is
    /// compiled.
    template <class Op>
    requires(std::derived_from<Op, Operator>) Stage(const Op& op) {
        static_assert(members_fit<P>());
        take(op);
    }
    /// A step made by hand.
    Stage(Step<P> step) { add(std::move(step)); }

    /// Joins another pipeline's stages to its end.
    void append(const Stage& other) {
        for (const auto& place : other.places_) {
            add(place.step);
            places_.back().written = place.written;
        }
    }
    /// Says where the stages were written that know no better, so that what they are refused for is told
    /// there.
    void locate(const std::string& text, std::size_t column) {
        for (auto& place : places_)
            if (!place.written)
                place.written = {text, column};
    }

    /// Throws UsageError when the pipeline cannot work on a population of which this is known.
    void check(CheckState& known) const {
        for (const auto& place : places_)
            place.located([&] {
                if (known.nobody && !place.step.begins)
                    throw UsageError("stage '" + place.step.text +
                                     "' needs a population; expected one to start with, or sample before it");
                place.step.check(known);
                known.nobody = false;
            });
    }
    /// Throws UsageError where the pipeline leaves the population unscored.
    void check_end(const CheckState& known) const {
        if (!known.scored && !places_.empty())
            places_.back().located([&] {
                throw UsageError("stage '" + places_.back().step.text +
                                 "' leaves the population unscored at the end; expected score after it");
            });
    }

    /// Sends a population through every stage, each at its own place of the context. Throws Stopped when the
    /// budget is spent, NothingLeft when a selection leaves nobody.
    Population<Genome> operator()(Population<Genome> population, Context<P>& context) const {
        typename Context<P>::OpenFrame frame(context.state, std::move(population));
        expect_fit(frame->next <= places_.size());
        try {
            while (frame->next < places_.size()) {
                apply(places_[frame->next], *frame, context);
                ++frame->next;
                context.pause();
            }
        } catch (const Stopped&) {
            if (!context.state.in_hand)
                context.state.in_hand = std::move(frame->population);
            throw;
        }
        return std::move(frame->population);
    }

    /// The pipeline as text; the parser makes the same pipeline of it.
    std::string text() const {
        std::string text;
        for (const auto& place : places_)
            text += (text.empty() ? "" : " | ") + place.step.text;
        return text;
    }
    bool empty() const { return places_.empty(); }                                  ///< without any stage
    bool begins() const { return !places_.empty() && places_.front().step.begins; } ///< needs no population
    /// How many of the best at the start of a generation its stages read.
    std::size_t reads_of_start() const {
        std::size_t most = 0;
        for (const auto& place : places_)
            most = std::max(most, place.step.reads_of_start);
        return most;
    }

  private:
    struct Place {
        Step<P> step;
        Name name;
        std::size_t ordinal = 1;
        std::optional<std::pair<std::string, std::size_t>> written = {}; ///< text and column

        template <class Check>
        void located(Check check) const {
            try {
                check();
            } catch (const TextError&) {
                throw;
            } catch (const UsageError& error) {
                if (!written)
                    throw;
                throw TextError(written->first, written->second, error.what());
            }
        }
    };

    /// Keeps what is needed to go on from before the stage, if anybody keeps the run.
    static void apply(const Place& place, Frame<Genome>& frame, Context<P>& context) {
        const typename Context<P>::Scope scope(context.position, place.name, place.ordinal);
        if (!context.is_kept()) {
            frame.population = place.step.apply(std::move(frame.population), context);
        } else {
            const auto before = context.snapshot(false);
            const Population<Genome> start = frame.population;
            try {
                frame.population = place.step.apply(std::move(frame.population), context);
            } catch (const Stopped&) {
                frame.population = start;
                context.keep_stopped(before);
                throw;
            }
        }
        context.show(frame.population);
    }

    template <class A, class B>
    void take(const Then<A, B>& pair) {
        take(pair.first);
        take(pair.second);
    }
    template <class Op>
    [[gnu::cold]] void take(const Op& op) {
        if constexpr (requires { op.template check_problem<P>(); })
            op.template check_problem<P>();
        if constexpr (Block<Op, P>)
            add(op.template step<P>());
        else
            add_operator(op);
    }
    /// An operator whose type is known no more: the compiler makes Step's functions once for all of them.
    struct AnyOperator {
        virtual ~AnyOperator() = default;
        virtual void check(CheckState& known) const = 0;
        virtual Population<Genome> apply(Population<Genome> population, Context<P>& context) const = 0;
    };
    template <class Op>
    struct OneOperator final : AnyOperator {
        Op op;

        explicit OneOperator(const Op& op_) : op(op_) {}
        void check(CheckState& known) const override { op.check(known); }
        Population<Genome> apply(Population<Genome> population, Context<P>& context) const override {
            if constexpr (requires { typename Op::State; }) {
                HeldState& held = context.state.loops.back()->states[context.path()];
                auto& state = held.template as<typename Op::State>();
                const auto before = state;
                try {
                    return op(std::move(population), context, state);
                } catch (const Stopped&) {
                    state = before;
                    throw;
                }
            } else {
                return op(std::move(population), context);
            }
        }
    };

    template <class Op>
    [[gnu::cold]] void add_operator(const Op& op) {
        if constexpr (!requires { typename Op::State; } &&
                      !std::is_invocable_v<const Op&, Population<Genome>, Context<P>&>) {
            static_assert(std::is_invocable_v<const Op&, Population<Genome>, Context<P>&>,
                          "this operator needs what the problem or its genome does not have; the compiler "
                          "names it below");
            // No more callable here, where the compiler says which constraint is at fault.
            using Answer [[maybe_unused]] = decltype(op(Population<Genome>(), std::declval<Context<P>&>()));
        } else {
            Step<P>& step = add(stage_text(op), std::unique_ptr<const AnyOperator>(new OneOperator<Op>(op)));
            if constexpr (requires { op.reads_of_start(); })
                step.reads_of_start = op.reads_of_start();
            if constexpr (requires { Op::begins; })
                step.begins = Op::begins;
        }
    }

    [[gnu::cold, gnu::noinline]] Step<P>& add(std::string text, std::shared_ptr<const AnyOperator> any) {
        Step<P>& step = add(std::move(text));
        step.check = [any](CheckState& known) { any->check(known); };
        step.apply = [any](Population<Genome> population, Context<P>& context) {
            return any->apply(std::move(population), context);
        };
        return step;
    }
    [[gnu::cold, gnu::noinline]] Step<P>& add(std::string text) {
        const Name name(text.substr(0, text.find_first_of(" ({")));
        std::size_t ordinal = 1;
        for (const Place& place : places_)
            ordinal += place.name == name ? 1 : 0;
        Place& place = places_.emplace_back();
        place.step.text = std::move(text);
        place.name = name;
        place.ordinal = ordinal;
        return place.step;
    }
    [[gnu::cold, gnu::noinline]] void add(Step<P> step) {
        Step<P>& added = add(step.text);
        added = std::move(step);
    }

    std::vector<Place> places_;
};

/// Checks a body that runs generation after generation: what one leaves must suit the next. `more` looks at
/// what is known after the first.
template <Problem P, class More>
[[gnu::cold]] void check_generation(const Stage<P>& body, const std::string& name, CheckState& known,
                                    More more) {
    CheckState inside = known;
    inside.in_generation = true;
    inside.start_scored = known.scored;
    if (const std::size_t reads = body.reads_of_start(); reads > 0 && reads != everyone)
        known.need_score(name); // the best of its start are chosen
    body.check(inside);
    more(inside);
    if (inside.start_scored != inside.scored) { // else the second generation is checked as the first was
        inside.start_scored = inside.scored;
        body.check(inside);
    }
    known.scored = inside.scored;
}

/// a | b of operators, before the problem is known.
template <class A, class B>
requires std::derived_from<A, Operator> && std::derived_from<B, Operator> Then<A, B>
operator|(A a, B b) { return {std::move(a), std::move(b)}; }

/// a | b where the problem is known.
template <Problem P, class B>
requires std::convertible_to<B, Stage<P>> Stage<P>
operator|(Stage<P> a, const B& b) {
    a.append(Stage<P>(b));
    return a;
}

/// a | b where the problem is known.
template <class A, Problem P>
requires std::derived_from<A, Operator> Stage<P>
operator|(const A& a, const Stage<P>& b) {
    Stage<P> stage(a);
    stage.append(b);
    return stage;
}

} // namespace ga
