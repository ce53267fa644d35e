#pragma once

#include "ga/problem/comparison.hpp"
#include "ga/run/rounds.hpp"
#include "ga/run/state.hpp"

namespace ga {

/// What stages share while a pipeline runs, in three rooms: `where` the run stands, what is paid (the door,
/// with the ledger behind it), and what is `kept`. One for each run and for each island of it, passed down,
/// never global.
template <Problem P>
class Context {
  public:
    using Genome = typename P::Genome;                             ///< of the problem
    using Outcome = typename P::Outcome;                           ///< of the problem's evaluations
    using Scope = typename StagePosition<Genome>::Scope;           ///< see StagePosition
    using Round = typename StagePosition<Genome>::Round;           ///< see StagePosition
    using Generation = typename StagePosition<Genome>::Generation; ///< see StagePosition
    using OpenFrame = typename RunState<Genome>::OpenFrame;        ///< see RunState

    /// How much room populations have, whom observers are, and whether `score` may leave out whom the next
    /// stage would not keep.
    struct Terms {
        std::vector<Observer<Genome>> observers = {};        ///< see Observer
        Checkpointer<P>* keeper = nullptr;                   ///< none: the run is kept nowhere
        std::size_t population_bytes = std::size_t{1} << 30; ///< at most, for one population
    };

    /// The root of a run.
    [[gnu::cold]] Context(Ledger<P>& ledger, StagePosition<Genome> place, Identity next_identity, Terms terms)
        : position(std::move(place)), state(next_identity), ledger_(ledger), door_(ledger), root_(*this),
          terms_(std::move(terms)) {
        for (const auto& objective : problem().objectives())
            names_.push_back(Name(objective.name));
    }
    /// An island: it asks through `door`, gives out identities of a lane of its own, and shows observers what
    /// it did when its round is over.
    [[gnu::cold]] Context(Context& parent, EvaluationQueue<P>& door, std::size_t lane, std::size_t lanes)
        : position(parent.position), state(parent.state.next_identity + lane * parent.state.identity_step,
                                           parent.state.identity_step * lanes),
          ledger_(parent.ledger_), door_(door), root_(parent.root_), names_(parent.names_) {
        terms_.population_bytes = parent.terms_.population_bytes;
        state.earlier_seconds = parent.state.earlier_seconds;
        if (parent.observed())
            terms_.observers = {[this](const Event<Genome>& event) {
                shown_.push_back(
                    {event.path, event.generation, event.population, event.counters, event.seconds});
            }};
    }
    /// Under a problem derived from the parent's, with that one's ledger (run_derived).
    [[gnu::cold]] Context(Context& parent, Ledger<P>& ledger)
        : position(parent.position), state(parent.state.next_identity, parent.state.identity_step),
          ledger_(ledger), door_(ledger), root_(*this), names_(parent.names_) {
        terms_.population_bytes = parent.terms_.population_bytes;
        state.earlier_seconds = parent.seconds();
        if (parent.observed())
            terms_.observers = {[&parent](Event<Genome> event) {
                event.derived = true;
                for (const auto& observer : parent.terms_.observers)
                    observer(event);
            }};
    }
    Context(const Context&) = delete;

    StagePosition<Genome> position; ///< path, random streams, generation
    RunState<Genome> state;         ///< frames, identities, best, notes

    const P& problem() const { return ledger_.problem(); } ///< what is solved
    Ledger<P>& ledger() { return ledger_; }                ///< the engine's books
    const Ledger<P>& ledger() const { return ledger_; }    ///< the same, to read
    EvaluationQueue<P>& door() { return door_; }           ///< where everything paid is asked
    const Watch& watch() const { return ledger_.watch(); } ///< since the run began in this process
    Counters& counters() { return ledger_.counters; }      ///< paid for so far
    /// To work with beside evaluations; decides no result. One on an island.
    int threads() const { return this == &root_ ? ledger_.evaluator().threads() : 1; }

    Stream stream(std::size_t index) const { return position.stream(index); } ///< see StagePosition
    std::string path() const { return position.path(); }                      ///< see StagePosition
    /// See StagePosition.
    Population<Genome>& generation_start() const { return position.generation_start(); }

    /// The identity of a new individual.
    Identity new_identity() {
        return std::exchange(state.next_identity, state.next_identity + state.identity_step);
    }
    /// Makes an individual whose genome was changed a new, unscored one with these parents.
    void make_child(Individual<Genome>& individual, Parents parents) {
        individual.identity = new_identity();
        individual.parents = parents;
        individual.fitness = {};
        individual.origin.reset();
    }
    /// The individuals at these positions, copied into the memory of a population that is no more.
    Population<Genome> gather(Population<Genome> population, const std::vector<std::size_t>& positions) {
        spare_.resize(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i)
            spare_[i] = population[positions[i]];
        std::swap(spare_, population);
        return population;
    }

    /// Position of an objective in the problem's list; an empty name stands for the first.
    std::size_t objective_index(const std::string& name) const {
        const auto& objectives = problem().objectives();
        for (std::size_t i = 0; i < objectives.size(); ++i)
            if (name.empty() || objectives[i].name == name)
                return i;
        throw UsageError("unknown objective '" + name + "'");
    }
    /// Gives every individual its fitness under an objective (empty: the problem's first), evaluating where
    /// needed.
    void score(Population<Genome>& population, const std::string& objective_name,
               Patience patience = Patience::none) {
        const std::size_t which = objective_index(objective_name);
        const auto& objective = problem().objectives()[which];
        const Name name = names_[which];
        visit(
            population, [&](const auto& individual) { return !individual.fitness.known(name); },
            [&](auto& individual, const Evaluation<Outcome>& evaluation) {
                individual.fitness = fitness_of(problem(), evaluation, objective, name);
            },
            patience);
    }
    /// Calls assign(individual, evaluation), which sets the fitness, for every individual, evaluating where
    /// needed.
    template <class Assign>
    void evaluate(Population<Genome>& population, Assign assign) {
        visit(
            population, [](const auto&) { return true; }, assign, Patience::none);
    }

    /// Gives every individual the mean fitness of n more replicates of a noisy evaluation than it had, but of
    /// no more than `limit`; replicates that are known are not evaluated again. One failure fails the
    /// individual.
    void average(Population<Genome>& population, const std::string& objective_name, std::size_t n,
                 std::size_t limit) {
        const std::size_t which = objective_index(objective_name);
        inquiry_.questions.clear();
        asked_.clear();
        std::vector<std::size_t> firsts;
        for (auto& individual : population) {
            const Fitness& known = individual.fitness;
            const std::size_t had = known.known(names_[which]) ? known.replicates() : 0;
            if (had >= std::max(n, limit) || known.has_failed())
                continue;
            firsts.push_back(inquiry_.questions.size());
            asked_.push_back(&individual);
            for (std::size_t r = 0; r < std::min(had + n, std::max(n, limit)); ++r)
                inquiry_.questions.push_back({&individual.genome, r > 0 ? r >= had : !known.known(), r});
        }
        firsts.push_back(inquiry_.questions.size());
        inquiry_.patience = Patience::none;
        inquiry_.use = [&] {
            auto& best = root_.state.best;
            for (std::size_t i = 0; i < asked_.size(); ++i) {
                const auto mean = mean_of(firsts[i], firsts[i + 1] - firsts[i], which);
                if (!mean)
                    continue;
                asked_[i]->fitness = *mean;
                ledger_.note(*mean);
                counters().failures += mean->has_failed() ? 1 : 0;
                if (best && best->identity == asked_[i]->identity && mean->known(names_[0]))
                    best = *asked_[i]; // with more replicates it may be worse than it seemed
            }
            for (const auto& individual : population)
                offer(individual);
        };
        serve(population);
    }

    /// Remembers the individual if it is the best so far under the problem's first objective.
    void offer(const Individual<Genome>& individual) {
        auto& best = root_.state.best;
        if (individual.fitness.known(names_[0]) && !individual.fitness.has_failed() &&
            (!best || better(individual.fitness, best->fitness)))
            best = individual;
    }
    /// None until something was scored.
    const std::optional<Individual<Genome>>& best() const { return root_.state.best; }
    /// The name of the problem's objective at that place.
    Name objective_name(std::size_t place) const { return names_[place]; }

    /// A remark for the run's result, under the path of the stage that runs.
    void note(const std::string& text) { state.note(path() + ": " + text); }

    /// Ends the run with what it has in hand where a population of so many would exceed the memory for one.
    /// Called by whoever makes a population larger, before. `like` is one of the new, where they are not like
    /// those in hand.
    void need_room(std::size_t individuals, const Population<Genome>& in_hand, const Genome* like = nullptr) {
        if (in_hand.empty() && !like)
            return;
        const Genome& genome = like ? *like : in_hand.front().genome;
        std::size_t each = sizeof(Individual<Genome>);
        if constexpr (Keyed<P>)
            each += 2 * std::string(problem().key(genome)).size();
        else if constexpr (std::ranges::sized_range<const Genome>)
            each += std::ranges::size(genome) * sizeof(std::ranges::range_value_t<const Genome>);
        if (individuals <= terms_.population_bytes / each)
            return;
        state.in_hand = in_hand;
        throw Stopped{path() + ": a population of " + std::to_string(individuals) + " exceeds the " +
                      std::to_string(terms_.population_bytes >> 20) + " MB for one"};
    }

    bool observed() const { return !terms_.observers.empty(); } ///< whether anybody looks on
    /// Shows the observers what the stage that runs has made.
    void show(const Population<Genome>& population) {
        if (!observed())
            return;
        const std::string here = path();
        const std::vector<std::size_t> generation = position.generations();
        for (const auto& observer : terms_.observers)
            observer({here, generation, population, ledger_.counters, seconds()});
    }
    /// Shows the observers of this context what an island has shown in its round.
    void show_again(Context& island) {
        for (const Shown& each : island.shown_)
            for (const auto& observer : terms_.observers)
                observer({each.path, each.generation, each.population, each.counters, each.seconds});
        island.shown_.clear();
        for (const std::string& note : island.state.notes())
            state.note(note);
    }

    /// Keeps the memory to its bound, outside islands.
    void forget_old() {
        if (this == &root_)
            ledger_.forget_old();
    }
    /// A moment between two stages, at which a run may end or be written down.
    void pause() {
        forget_old();
        if (Checkpointer<P>* keeper = terms_.keeper; keeper && keeper->due(seconds()))
            keeper->write(snapshot(), ledger_);
        if (!watch().expired())
            return;
        if (terms_.keeper)
            keep_stopped(snapshot(false));
        throw Stopped{watch().reason()};
    }
    bool is_kept() const { return terms_.keeper != nullptr; } ///< whether somebody keeps the run
    /// Writes the run down as it was at a moment before, if it is time to.
    void keep_as(const Snapshot<Genome>& before) {
        if (terms_.keeper && terms_.keeper->due(seconds()))
            terms_.keeper->write(before, ledger_);
    }
    /// The run as it is now, between two stages, with or without the frames' populations.
    [[gnu::cold]] Snapshot<Genome> snapshot(bool with_frames = true) const {
        return {with_frames ? state.frames : std::list<Frame<Genome>>(),
                ledger_.counters,
                state.next_identity,
                state.best,
                state.notes(),
                seconds(),
                ledger_.memory().young().size(),
                ledger_.heaviest()};
    }
    /// Goes on from a snapshot: blocks that open find their frames in it.
    [[gnu::cold]] void resume(Snapshot<Genome> snapshot) {
        state.saved = std::move(snapshot.frames);
        ledger_.counters = snapshot.counters;
        state.next_identity = snapshot.next_identity;
        state.best = std::move(snapshot.best);
        state.resume_notes(std::move(snapshot.notes));
        state.earlier_seconds = snapshot.seconds;
        ledger_.resume(state.best.has_value(), snapshot.heaviest);
    }
    /// Hands the keeper a run that stopped inside a stage, as it was before that stage; the innermost block
    /// knows.
    [[gnu::cold]] void keep_stopped(Snapshot<Genome> before) {
        if (std::exchange(stop_kept_, true))
            return;
        before.frames = state.frames;
        terms_.keeper->write(before, ledger_);
    }
    /// Since the run began, in all the processes that carried it.
    double seconds() const { return state.earlier_seconds + watch().seconds(); }

  private:
    struct Shown {
        std::string path;
        std::vector<std::size_t> generation;
        Population<Genome> population;
        Counters counters;
        double seconds;
    };

    template <class Wanted, class Assign>
    void visit(Population<Genome>& population, Wanted wanted, Assign assign, Patience patience) {
        inquiry_.questions.clear();
        asked_.clear();
        for (auto& individual : population)
            if (wanted(std::as_const(individual))) {
                inquiry_.questions.push_back({&individual.genome, !individual.fitness.known()});
                asked_.push_back(&individual);
            }
        inquiry_.patience = patience;
        inquiry_.use = [&] {
            for (std::size_t i = 0; i < asked_.size(); ++i) {
                const Evaluation<Outcome>* answer = inquiry_.questions[i].answer;
                if (!answer || std::holds_alternative<Pending>(*answer))
                    continue;
                auto& individual = *asked_[i];
                assign(individual, *answer);
                ledger_.note(individual.fitness);
                if (individual.fitness.has_failed())
                    ++counters().failures;
                else if constexpr (Settling<P>)
                    individual.genome = problem().settled(individual.genome, std::get<Outcome>(*answer));
                offer(individual);
            }
        };
        serve(population);
    }
    /// Asks what is in the request; a run that has to stop keeps the population in hand.
    void serve(const Population<Genome>& population) {
        try {
            door_.serve(inquiry_);
        } catch (const Stopped&) {
            state.in_hand = population;
            throw;
        }
    }
    /// Of n answers from one on; none where one is missing.
    std::optional<Fitness> mean_of(std::size_t from, std::size_t n, std::size_t which) const {
        const auto& objective = problem().objectives()[which];
        double value = 0;
        std::vector<double> violations;
        for (std::size_t i = from; i < from + n; ++i) {
            const Evaluation<Outcome>* answer = inquiry_.questions[i].answer;
            if (!answer || std::holds_alternative<Pending>(*answer))
                return std::nullopt;
            const Fitness one = fitness_of(problem(), *answer, objective, names_[which]);
            if (one.has_failed())
                return one;
            value += one.value() / static_cast<double>(n);
            violations.resize(std::max(violations.size(), one.violations().size()), 0);
            for (std::size_t k = 0; k < one.violations().size(); ++k)
                violations[k] += one.violations()[k] / static_cast<double>(n);
        }
        return Fitness(names_[which], value, objective.minimise)
            .constrained(std::move(violations))
            .averaged(n);
    }

    Ledger<P>& ledger_;
    EvaluationQueue<P>& door_;
    Context& root_;
    Terms terms_;
    std::vector<Name> names_; ///< of the problem's objectives, same order
    EvaluationRequest<P> inquiry_;
    std::vector<Individual<Genome>*> asked_;
    Population<Genome> spare_;
    std::vector<Shown> shown_;
    bool stop_kept_ = false;
};

} // namespace ga
