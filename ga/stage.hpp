#pragma once

#include "ga/check.hpp"
#include "ga/context.hpp"

namespace ga {

/// One operator for one type of problem: its text ("best 3"; the first word is its name), what it needs, what
/// it does.
template <Problem P>
struct Step {
    using Genome = typename P::Genome; ///< of the problem
    std::string text;                  ///< as pipelines write it
    std::function<void(Known&)> check; ///< what it needs and makes known
    std::function<Population<Genome>(Population<Genome>, Context<P>&)> apply; ///< what it does
    std::size_t reads_of_start = 0;    ///< how many of the best at the start of its generation it reads
    std::optional<Demand> demand = {}; ///< whom it keeps of a scored population, where it says so
};

/// An operator is a small struct with
///     std::string text() const;                                  as it is written in a text pipeline
///     void check(Known&) const;                                  what it needs and makes known
///     Population operator()(Population, Context<P>&) const;      a template over the problem P, constrained
///                                                                by what it uses
/// deriving from this tag, which gives it `|`. One that reads the start of its generation says how much of
/// it by
///     std::size_t reads_of_start() const;                        the best so many; everyone for all
/// One that keeps a part of a scored population, whatever the others' fitness, says which by
///     Demand demand() const;
/// One that needs of a problem what no concept can tell has `template <Problem P> void check_problem()
/// const`.
struct Operator {};

/// What reads_of_start() gives for the whole population.
constexpr std::size_t everyone = static_cast<std::size_t>(-1);

/// An operator that holds pipelines gives, in place of the call, `template <Problem P> Step<P> step() const`.
template <class Op, class P>
concept Block = requires(const Op& op) {
    op.template step<P>();
};

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
    /// An operator as a pipeline of one stage. Throws UsageError where the problem lacks what it needs; what
    /// concepts can tell is refused when it is compiled.
    template <class Op>
    requires(std::derived_from<Op, Operator>) Stage(Op op) {
        if constexpr (requires { op.template check_problem<P>(); })
            op.template check_problem<P>();
        if constexpr (Block<Op, P>)
            add(op.template step<P>());
        else if constexpr (!std::is_invocable_v<const Op&, Population<Genome>, Context<P>&>) {
            static_assert(std::is_invocable_v<const Op&, Population<Genome>, Context<P>&>,
                          "this operator needs what the problem or its genome does not have; the compiler "
                          "names it below");
            // No more callable here, where the compiler says which constraint is at fault.
            using Answer [[maybe_unused]] = decltype(op(Population<Genome>(), std::declval<Context<P>&>()));
        } else {
            add({op.text(), [op](Known& known) { op.check(known); },
                 [op](Population<Genome> population, Context<P>& context) {
                     return op(std::move(population), context);
                 },
                 start_of(op), demand_of(op)});
        }
    }
    /// Operators joined by `|` before the problem was known.
    template <class A, class B>
    Stage(Then<A, B> pair) : Stage(std::move(pair.first)) {
        append(Stage(std::move(pair.second)));
    }
    /// A step made by hand.
    Stage(Step<P> step) { add(std::move(step)); }

    /// Joins another pipeline's stages to its end.
    void append(const Stage& other) {
        for (const auto& place : other.places_)
            add(place.step);
    }

    /// Throws UsageError when the pipeline cannot work on a population of which this is known.
    void check(Known& known) const {
        for (const auto& place : places_)
            place.step.check(known);
    }

    /// The same pipeline with every stage's check made by wrap(check, known).
    template <class Wrap>
    Stage with_checks(Wrap wrap) const {
        Stage wrapped = *this;
        for (auto& place : wrapped.places_)
            place.step.check = [wrap, check = place.step.check](Known& known) { wrap(check, known); };
        return wrapped;
    }

    /// Sends a population through every stage, each at its own place of the context. Throws Stopped when the
    /// budget is spent, NothingLeft when a selection leaves nobody.
    Population<Genome> operator()(Population<Genome> population, Context<P>& context) const {
        typename Context<P>::OpenFrame frame(context, std::move(population));
        while (frame->next < places_.size()) {
            context.expect(frame->next + 1 < places_.size() ? places_[frame->next + 1].step.demand
                                                            : std::nullopt);
            apply(places_[frame->next], *frame, context);
            ++frame->next;
            context.pause();
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
    bool empty() const { return places_.empty(); } ///< without any stage
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
        std::size_t ordinal;
    };

    static void apply(const Place& place, Frame<Genome>& frame, Context<P>& context) {
        const typename Context<P>::Scope scope(context, place.name, place.ordinal);
        if (!context.kept()) {
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

    template <class Op>
    static std::optional<Demand> demand_of(const Op& op) {
        if constexpr (requires { op.demand(); })
            return op.demand();
        else
            return std::nullopt;
    }
    template <class Op>
    static std::size_t start_of(const Op& op) {
        if constexpr (requires { op.reads_of_start(); })
            return op.reads_of_start();
        else
            return 0;
    }

    void add(Step<P> step) {
        const Name name(step.text.substr(0, step.text.find_first_of(" ({")));
        const auto equal = std::count_if(places_.begin(), places_.end(),
                                         [&](const Place& place) { return place.name == name; });
        places_.push_back({std::move(step), name, static_cast<std::size_t>(equal) + 1});
    }

    std::vector<Place> places_;
};

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
operator|(A a, const Stage<P>& b) {
    Stage<P> stage(std::move(a));
    stage.append(b);
    return stage;
}

} // namespace ga
