#pragma once

#include "ga/pipeline/parameters.hpp"
#include "ga/run/context.hpp"

namespace ga {

/// Properties of a population at one point of a pipeline that are known before the pipeline runs. Each stage
/// checks whether it can work on such a population, and updates the properties. A stage that cannot work
/// throws UsageError. A policy is one objective, or several objectives (`pareto`).
struct CheckState {
    std::vector<std::string> objectives;     ///< names of the problem's objectives; the first is the default
    std::optional<std::string> scored;       ///< policy under which every individual is scored
    bool in_generation = false;              ///< whether the point is inside a `repeat` or `until`
    std::optional<std::string> start_scored; ///< policy under which the generation's start is scored
    bool nobody = false;                     ///< whether the population is still empty
    std::size_t at_most = all_individuals;   ///< upper bound on the number of individuals, if one is known
    std::string trials = {};   ///< stage of the generation whose children need a comparison with their parents
    bool on_islands = false;   ///< whether the point is inside `islands`
    bool has_gradient = false; ///< whether the problem has derivatives of its fitness
    /// Whether the population is scored under several objectives.
    bool several_objectives() const { return scored && scored->find(' ') != std::string::npos; }

    /// Throws UsageError, with the stage's name, if individuals may be unscored.
    void need_score(const std::string& stage) const;
    /// Throws UsageError, with the stage's name, if the fitness has several objectives.
    void need_one_objective(const std::string& stage) const;
    /// Throws UsageError, with the stage's name, unless individuals were scored by `pareto`.
    void need_several_objectives(const std::string& stage) const;
    /// Throws UsageError, with the stage's name and purpose, if the stage is not in a block of generations.
    void need_generation(const std::string& stage, const std::string& does = "reads the start of a generation") const;
    /// Throws UsageError if a stage that learns is not in a block of generations.
    void need_repetition(const std::string& stage) const;
    /// Throws UsageError, with the stage's name, if there are surely fewer than n individuals.
    void need_individuals(const std::string& stage, std::size_t n) const;
    /// Throws UsageError, with the stage's name, if the stage is not in a block of generations. Also throws
    /// it if the generation's start and the population are scored under different policies.
    void need_comparable_start(const std::string& stage) const;
    /// The name of an objective; an empty name stands for the problem's first. Throws UsageError if the name
    /// is unknown.
    std::string objective(const std::string& stage, const std::string& name) const;
};

/// One operator for one type of problem: its text ("best 3"; the first word is its name), its check and its action.
template <Problem P>
struct Stage {
    using Genome = typename P::Genome;      ///< genome of the problem
    std::string text;                       ///< text of the operator in pipelines
    std::function<void(CheckState&)> check; ///< checks whether the operator can work, updates the CheckState
    std::function<Population<Genome>(Population<Genome>, Context<P>&)> apply; ///< the operator's action
    std::size_t reads_of_start = 0;                                           ///< see Operator
    bool begins = false;                                                      ///< see Operator
    bool keeps_size = false;                                                  ///< see Operator
};

// clang-format off
/// An operator is a small struct with these members. It derives from this tag, which gives it `|`.
/// @code
///     words() and describe(), or text()                       give the operator's text (parameters.hpp)
///     void check(CheckState&) const;                          checks whether the operator can work on the
///                                                         population, and updates the CheckState
///     Population operator()(Population, Context<P>&) const;   does the work; a template over the problem P,
///                                                         constrained by the members of P that it uses
/// @endcode
/// It may also have
/// @code
///     struct State;                           state from one generation to the next; to_json and from_json
///                                             write and read it; the call takes a State& as last parameter
///     static constexpr const char* needs;     members that the problem must have, in words
/// @endcode
/// A block is an operator that contains pipelines. Instead of check and operator() it has
/// @code
///     template <Problem P> Stage<P> stage() const;
/// @endcode
// clang-format on
struct Operator : NoParameters {
    static constexpr bool begins = false;     ///< whether it works without a population
    static constexpr bool keeps_size = false; ///< whether it adds no individual, or check sets `at_most`
    /// Number of the best individuals that it reads of the generation's start, the population at its beginning.
    std::size_t reads_of_start() const { return 0; }
};

/// Returns the operator. Throws UsageError if a value is out of range.
template <class Op>
requires std::derived_from<Op, Operator>
[[gnu::cold]] Op checked(Op op) {
    check_values(op, Op::words().name);
    return op;
}

/// An operator that the problem and its genome allow to call.
template <class Op, class P>
concept Callable = std::invocable < const Op&,
        PopulationOf<P>, Context<P>
& > || std::invocable<const Op&, PopulationOf<P>, Context<P>&, typename Op::State&>;

/// a | b for any problem.
template <class A, class B>
struct Sequence : Operator {
    A first;  ///< operator that runs first
    B second; ///< operator that runs on the result of the first
};

/// A pipeline: a list of operators, Population -> Population. `|` joins lists, so that parentheses have no effect.
template <Problem P>
class Pipeline {
  public:
    using Genome = typename P::Genome; ///< genome of the problem

    Pipeline() = default;
    /// A pipeline of one operator, or of several operators with `|` between them. The compiler checks the
    /// requirements that concepts can express. Throws UsageError if another requirement is not met.
    template <class Op>
    requires(std::derived_from<Op, Operator>) Pipeline(const Op& op) {
        static_assert(members_fit<P>());
        take(op);
    }
    /// A pipeline of one stage.
    Pipeline(Stage<P> stage) { add(std::move(stage)); }

    /// Appends the stages of another pipeline.
    void append(const Pipeline& other) {
        for (const auto& placed : other.stages_) {
            add(placed.stage);
            stages_.back().written = placed.written;
        }
    }
    /// Sets the text and the column that error messages name, for stages that do not have them yet.
    void locate(const std::string& text, std::size_t column) {
        for (auto& placed : stages_)
            if (!placed.written) placed.written = {text, column};
    }

    /// Throws UsageError if the pipeline cannot work on a population with the properties in `known`.
    void check(CheckState& known) const {
        for (const auto& placed : stages_)
            placed.located([&] {
                if (known.nobody && !placed.stage.begins)
                    throw UsageError("stage '" + placed.stage.text +
                                     "' needs a population; give one at the start, or put sample before it");
                placed.stage.check(known);
                known.nobody = false;
                if (!placed.stage.keeps_size) known.at_most = all_individuals;
            });
    }
    /// Throws UsageError if the pipeline leaves the population unscored.
    void check_end(const CheckState& known) const {
        if (!known.scored && !stages_.empty())
            stages_.back().located([&] {
                throw UsageError("stage '" + stages_.back().stage.text +
                                 "' leaves the population unscored at the end; put score after it");
            });
    }

    /// Sends a population through every stage. Throws Stopped when the budget is spent or a selection is empty.
    Population<Genome> operator()(Population<Genome> population, Context<P>& context) const {
        typename Context<P>::OpenFrame frame(context.state, std::move(population));
        expect_fit(frame->next <= stages_.size());
        try {
            while (frame->next < stages_.size()) {
                apply(stages_[frame->next], *frame, context);
                ++frame->next;
                context.pause();
            }
        } catch (const Stopped&) {
            if (!context.state.stopped_population) context.state.stopped_population = std::move(frame->population);
            throw;
        }
        return std::move(frame->population);
    }

    /// The pipeline as text, from which the parser makes the same pipeline.
    std::string text() const {
        std::string text;
        for (const auto& placed : stages_) text += (text.empty() ? "" : " | ") + placed.stage.text;
        return text;
    }
    /// Whether the pipeline works without a population.
    bool begins() const { return !stages_.empty() && stages_.front().stage.begins; }
    /// Number of the best individuals of a generation's start that the stages read.
    std::size_t reads_of_start() const {
        std::size_t max = 0;
        for (const auto& placed : stages_) max = std::max(max, placed.stage.reads_of_start);
        return max;
    }

  private:
    struct PlacedStage {
        Stage<P> stage;
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
                if (!written) throw;
                throw TextError(written->first, written->second, error.what());
            }
        }
    };

    /// Runs one stage. If the run stops inside it, the checkpoint holds the state before the stage. An
    /// exception of the problem is such a stop once the run has found something.
    static void apply(const PlacedStage& placed, Frame<Genome>& frame, Context<P>& context) {
        const typename Context<P>::Scope scope(context.position, placed.name, placed.ordinal);
        std::optional<std::pair<Snapshot<Genome>, Population<Genome>>> before;
        if (context.is_kept()) before.emplace(context.snapshot(false), frame.population);
        const auto keep = [&] {
            if (!before) return;
            frame.population = std::move(before->second);
            context.keep_stopped(std::move(before->first));
        };
        try {
            frame.population = placed.stage.apply(std::move(frame.population), context);
        } catch (const Stopped&) {
            keep();
            throw;
        } catch (const UsageError&) {
            throw;
        } catch (const std::exception& error) { // thrown by a member of the problem, e.g. `sample`
            if (!context.best() || context.ledger().evaluator_failed) throw;
            keep();
            throw Stopped{"stage '" + placed.stage.text + "' cannot continue: " + error.what(), true};
        }
        context.show(frame.population);
    }

    template <class A, class B>
    void take(const Sequence<A, B>& pair) {
        take(pair.first);
        take(pair.second);
    }
    template <class Op>
    [[gnu::cold]] void take(const Op& op) {
        if constexpr (requires { op.template stage<P>(); }) {
            add(op.template stage<P>());
        } else if constexpr (!requires { typename Op::State; } && !Callable<Op, P>) {
            static_assert(Callable<Op, P>,
                          "this operator needs what the problem or its genome does not have; the compiler "
                          "names it below");
            // Not callable; here the compiler names the constraint.
            using Called [[maybe_unused]] = decltype(op(Population<Genome>(), std::declval<Context<P>&>()));
        } else {
            std::string text;
            if constexpr (requires { op.text(); })
                text = op.text();
            else
                text = text_of(op);
            add({std::move(text), [op](CheckState& known) { op.check(known); },
                 [op](Population<Genome> population, Context<P>& context) {
                     return applied(op, std::move(population), context);
                 },
                 op.reads_of_start(), Op::begins, Op::keeps_size});
        }
    }
    template <class Op>
    static Population<Genome> applied(const Op& op, Population<Genome> population, Context<P>& context) {
        if constexpr (requires { typename Op::State; }) {
            OperatorState& held = context.state.loops.back()->states[context.path()];
            auto& state = held.template as<typename Op::State>();
            const auto before = state;
            try {
                return op(std::move(population), context, state);
            } catch (...) {
                state = before;
                throw;
            }
        } else {
            return op(std::move(population), context);
        }
    }

    [[gnu::cold, gnu::noinline]] void add(Stage<P> stage) {
        const Name name(stage.text.substr(0, stage.text.find_first_of(" ({")));
        const auto earlier =
            std::ranges::count_if(stages_, [&](const PlacedStage& placed) { return placed.name == name; });
        stages_.push_back({std::move(stage), name, 1 + static_cast<std::size_t>(earlier)});
    }

    std::vector<PlacedStage> stages_;
};

/// Checks a body that runs in generations. Each generation must be able to work on the population that the
/// previous generation returns. `more` checks the CheckState after the first generation.
template <Problem P, class More>
[[gnu::cold]] void check_generation(const Pipeline<P>& body, const std::string& name, CheckState& known, More more) {
    CheckState inside = known;
    inside.in_generation = true;
    inside.start_scored = known.scored;
    if (const std::size_t reads = body.reads_of_start(); reads > 0 && reads != all_individuals)
        known.need_score(name); // its best are ranked
    inside.trials.clear();
    body.check(inside);
    more(inside);
    if (!inside.trials.empty() && body.reads_of_start() == 0)
        throw UsageError("stage '" + inside.trials +
                         "' replaces parents by children that may be worse; put duel after the score");
    if (inside.start_scored != inside.scored) { // otherwise the second check equals the first
        inside.start_scored = inside.scored;
        body.check(inside);
    }
    known.scored = inside.scored;
}

/// a | b of operators, for any problem.
template <class A, class B>
requires std::derived_from<A, Operator> && std::derived_from<B, Operator> Sequence<A, B>
operator|(A a, B b) { return {{}, std::move(a), std::move(b)}; }

/// a | b of a pipeline and an operator.
template <Problem P, class B>
requires std::convertible_to<B, Pipeline<P>> Pipeline<P>
operator|(Pipeline<P> a, const B& b) {
    a.append(Pipeline<P>(b));
    return a;
}

/// a | b of an operator and a pipeline.
template <class A, Problem P>
requires std::derived_from<A, Operator> Pipeline<P>
operator|(const A& a, const Pipeline<P>& b) {
    Pipeline<P> pipeline(a);
    pipeline.append(b);
    return pipeline;
}

} // namespace ga
