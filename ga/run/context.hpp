#pragma once

#include "ga/problem/comparison.hpp"
#include "ga/run/rounds.hpp"
#include "ga/run/state.hpp"

namespace ga {

/// The state that stages share while a pipeline runs: the current position, the queue of evaluations, the ledger and
/// the run's state. There is one for the run, one for each island and one for each derived problem.
template <Problem P>
class Context {
  public:
    using Genome = typename P::Genome;                      ///< genome of the problem
    using Outcome = typename P::Outcome;                    ///< the outcome of its evaluations
    using Scope = typename StagePosition<Genome>::Scope;    ///< see StagePosition
    using Round = typename StagePosition<Genome>::Round;    ///< see StagePosition
    using OpenFrame = typename RunState<Genome>::OpenFrame; ///< see RunState

    /// The context of a run. One population may take `population_bytes`. Checkpoints are written only with a
    /// checkpointer.
    [[gnu::cold]] Context(Ledger<P>& ledger, StagePosition<Genome> place, Identity next_identity,
                          std::size_t population_bytes, std::vector<Observer<Genome>> observers = {},
                          Checkpointer<P>* checkpointer = nullptr)
        : position(std::move(place)), state(next_identity), ledger_(ledger), queue_(ledger), root_(*this),
          observers_(std::move(observers)), checkpointer_(checkpointer), population_bytes_(population_bytes) {
        for (const auto& objective : problem().objectives()) names_.push_back(Name(objective.name));
    }
    /// The context of island `lane` of `lanes`. Its requests go to `queue`, its new identities form
    /// a separate sequence, and observers see its events when the round is over.
    [[gnu::cold]] Context(Context& parent, EvaluationQueue<P>& queue, std::size_t lane, std::size_t lanes)
        : position(parent.position),
          state(parent.state.next_identity + lane * parent.state.identity_step, parent.state.identity_step * lanes),
          ledger_(parent.ledger_), queue_(queue), root_(parent.root_), population_bytes_(parent.population_bytes_),
          names_(parent.names_) {
        state.earlier_seconds = parent.state.earlier_seconds;
        if (parent.observed())
            observers_ = {[this](const Event<Genome>& event) {
                shown_.push_back({event.path, event.generation, event.population, event.counters, event.seconds});
            }};
    }
    /// A context for a problem that is derived from the parent's, with another ledger (run_derived).
    [[gnu::cold]] Context(Context& parent, Ledger<P>& ledger)
        : position(parent.position), state(parent.state.next_identity, parent.state.identity_step), ledger_(ledger),
          queue_(ledger), root_(*this), population_bytes_(parent.population_bytes_), names_(parent.names_) {
        state.earlier_seconds = parent.seconds();
        if (parent.observed())
            observers_ = {[&parent](Event<Genome> event) {
                event.derived = true;
                parent.report(event);
            }};
    }
    Context(const Context&) = delete;

    StagePosition<Genome> position; ///< path, random streams and generation of the current stage
    RunState<Genome> state;         ///< frames of open blocks, identities, best individual, notes

    const P& problem() const { return ledger_.problem(); } ///< the problem that is solved
    Ledger<P>& ledger() { return ledger_; }                ///< memory, budget and counts
    EvaluationQueue<P>& queue() { return queue_; }         ///< queue that makes evaluations
    const Watch& watch() const { return ledger_.watch(); } ///< watch of the time in this process
    Counters& counters() { return ledger_.counters; }      ///< evaluations spent so far
    /// Number of threads for work other than evaluations; 1 on an island. It does not affect a result.
    int threads() const { return this == &root_ ? ledger_.evaluator().threads() : 1; }

    Stream stream(std::size_t index) const { return position.stream(index); } ///< see StagePosition
    std::string path() const { return position.path(); }                      ///< see StagePosition
    /// See StagePosition.
    Population<Genome>& generation_start() const { return position.generation_start(); }

    /// The identity of a new individual.
    Identity new_identity() { return std::exchange(state.next_identity, state.next_identity + state.identity_step); }
    /// Turns an individual with a changed genome into a new, unscored one with these parents.
    void make_child(Individual<Genome>& individual, Parents parents) {
        individual.identity = new_identity();
        individual.parents = parents;
        individual.fitness = {};
        individual.origin.reset();
    }
    /// Copies of the individuals at these positions, in memory that an earlier population no longer needs.
    Population<Genome> gather(Population<Genome> population, const std::vector<std::size_t>& positions) {
        spare_.resize(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) spare_[i] = population[positions[i]];
        std::swap(spare_, population);
        return population;
    }

    /// Position of an objective in the problem's list; an empty name stands for the first.
    std::size_t objective_index(const std::string& name) const {
        const auto& objectives = problem().objectives();
        for (std::size_t i = 0; i < objectives.size(); ++i)
            if (name.empty() || objectives[i].name == name) return i;
        throw UsageError("unknown objective '" + name + "'; use one of the problem");
    }
    /// Gives every individual its fitness under an objective (empty: the problem's first), with an evaluation
    /// if needed.
    void score(Population<Genome>& population, const std::string& objective_name,
               StopMode stop_mode = StopMode::at_once) {
        const std::size_t which = objective_index(objective_name);
        const auto& objective = problem().objectives()[which];
        const Name name = names_[which];
        visit(
            population, objective.level, [&](const auto& individual) { return !individual.fitness.known(name); },
            [&](auto& individual, const Evaluation<Outcome>& evaluation) {
                individual.fitness = fitness_of(problem(), evaluation, objective, name);
            },
            stop_mode);
    }
    /// Evaluates every individual for which wanted(individual) is true at a level, unless its outcome is
    /// known. Then calls assign(individual, evaluation), which sets the fitness.
    template <class Wanted, class Assign>
    void visit(Population<Genome>& population, Level level, Wanted wanted, Assign assign,
               StopMode stop_mode = StopMode::at_once) {
        request_.outcomes.clear();
        requested_.clear();
        for (auto& individual : population)
            if (wanted(std::as_const(individual))) {
                if constexpr (Repairs<P>) individual.genome = problem().repair(individual.genome);
                request_.outcomes.push_back(
                    {&individual.genome, !(individual.fitness.levels() & bit_of(level)), 0, level});
                requested_.push_back(&individual);
            }
        request_.stop_mode = stop_mode;
        request_.use = [&] {
            for (std::size_t i = 0; i < requested_.size(); ++i) {
                const Requested& wanted = request_.outcomes[i];
                if (!wanted.is_answered()) continue;
                auto& individual = *requested_[i];
                const auto levels = static_cast<std::uint8_t>(individual.fitness.levels() | bit_of(level));
                assign(individual, *wanted.answer);
                individual.fitness.set_levels(levels);
                if (individual.fitness.has_failed())
                    request_.fail(individual.fitness, wanted.counts ? 1 : 0);
                else if constexpr (HasFinalGenome<P>)
                    individual.genome = problem().final_genome(individual.genome, std::get<Outcome>(*wanted.answer));
                offer(individual);
            }
        };
        serve(population);
    }

    /// Adds n replicates to each individual that has not failed, up to max(n, limit) in total (Average). If
    /// one replicate fails, the individual is marked as failed. If `limit` is above n, individuals of the
    /// generation's start that may come back get replicates, too.
    void average(Population<Genome>& population, const std::string& objective_name, std::size_t n, std::size_t limit) {
        const std::size_t which = objective_index(objective_name);
        const Level level = problem().objectives()[which].level;
        request_.outcomes.clear();
        requested_.clear();
        std::vector<std::size_t> firsts;
        const auto request = [&](Individual<Genome>& individual) {
            const Fitness& known = individual.fitness;
            const std::size_t had = known.known(names_[which]) ? known.replicates() : 0;
            if (had >= std::max(n, limit) || known.has_failed()) return;
            if constexpr (Repairs<P>) individual.genome = problem().repair(individual.genome);
            firsts.push_back(request_.outcomes.size());
            requested_.push_back(&individual);
            for (std::size_t r = 0; r < std::min(had + n, std::max(n, limit)); ++r)
                request_.outcomes.push_back(
                    {&individual.genome, r > 0 ? r >= had : !(known.levels() & bit_of(level)), r, level});
        };
        for (auto& individual : population) request(individual);
        Population<Genome> start; // a copy, so that a stop leaves the start as it was
        if (limit > n && position.has_start()) {
            start = generation_start();
            const std::vector<Identity> present = identities_of(population);
            for (auto& old : start)
                if (old.fitness.known(names_[which]) && !std::ranges::binary_search(present, old.identity))
                    request(old);
        }
        firsts.push_back(request_.outcomes.size());
        request_.stop_mode = StopMode::at_once;
        request_.use = [&] {
            auto& best = root_.state.best;
            for (std::size_t i = 0; i < requested_.size(); ++i) {
                const auto replicates = std::span(request_.outcomes).subspan(firsts[i], firsts[i + 1] - firsts[i]);
                const auto mean = mean_of(replicates, which);
                if (!mean) continue;
                if (mean->has_failed()) request_.fail(*mean, std::ranges::count(replicates, true, &Requested::counts));
                const std::uint8_t levels = requested_[i]->fitness.levels();
                requested_[i]->fitness = *mean;
                requested_[i]->fitness.set_levels(static_cast<std::uint8_t>(levels | bit_of(level)));
                if (best && best->identity == requested_[i]->identity && mean->known(names_[0]))
                    best = *requested_[i]; // its mean over more replicates may be worse
            }
            offer_surest({&population, &start});
        };
        serve(population);
        if (!start.empty()) generation_start() = std::move(start);
    }

    /// Stores the individual if it is the best so far under the problem's first objective. A mean is never
    /// replaced by a fitness of fewer replicates, which may be better only by luck.
    void offer(const Individual<Genome>& individual) {
        auto& best = root_.state.best;
        const Fitness& fitness = individual.fitness;
        if (fitness.known(names_[0]) && !fitness.has_failed() &&
            (!best || (fitness.replicates() >= best->fitness.replicates() && better(fitness, best->fitness))))
            best = individual;
    }
    /// The best individual so far; none before the first evaluation.
    const std::optional<Individual<Genome>>& best() const { return root_.state.best; }
    /// The name of the objective at that position.
    Name objective_name(std::size_t place) const { return names_[place]; }

    /// Adds a remark to the run's result, under the path of the current stage.
    void note(const std::string& text) { state.note(path() + ": " + text); }

    /// Adds a remark that a derivative is missing, once for each stage.
    void note_missing_derivative(const std::string& why) {
        const std::string text = path() + ": a derivative is missing";
        for (const auto* notes : {&state.notes, &root_.state.notes})
            if (std::ranges::any_of(*notes, [&](const auto& note) { return note.starts_with(text); })) return;
        state.note(text + ": " + why);
    }

    /// Ends the run with this population as its result, because it cannot continue.
    [[noreturn, gnu::cold]] void end_with(Population<Genome> population, const std::string& why) {
        state.stopped_population = std::move(population);
        throw Stopped{path() + ": " + why, true};
    }
    /// Throws Stopped, with `population` as the result, if a population of `individuals` individuals would
    /// need more memory than one population may take. Stages call this before they make a population larger.
    /// The size of a genome is that of `example`, by default of the first genome in `population`.
    void need_room(std::size_t individuals, const Population<Genome>& population, const Genome* example = nullptr) {
        if (population.empty() && !example) return;
        const Genome& genome = example ? *example : population.front().genome;
        std::size_t each = sizeof(Individual<Genome>);
        if constexpr (Keyed<P>)
            each += 2 * std::string(problem().key(genome)).size();
        else if constexpr (std::ranges::sized_range<const Genome>)
            each += std::ranges::size(genome) * sizeof(std::ranges::range_value_t<const Genome>);
        if (individuals <= population_bytes_ / each) return;
        end_with(population, "a population of " + std::to_string(individuals) + " exceeds the " +
                                 std::to_string(population_bytes_ >> 20) + " MB for one");
    }

    bool observed() const { return !observers_.empty(); } ///< whether there are observers
    /// Shows the population that the current stage has made to the observers.
    void show(const Population<Genome>& population) {
        if (observed()) report({path(), position.generations(), population, ledger_.counters, seconds()});
    }
    /// Shows an island's events of the last round to the observers of this context.
    void show_again(Context& island) {
        for (const Shown& each : island.shown_)
            report({each.path, each.generation, each.population, each.counters, each.seconds});
        for (const std::string& note : island.state.notes) state.note(note);
    }

    /// Removes old evaluations so that the memory stays within its bound, except on islands.
    void forget_old() {
        if (this == &root_) ledger_.forget_old();
    }
    /// Called between two stages. The run may write a checkpoint or end here.
    void pause() {
        forget_old();
        if (checkpointer_ && checkpointer_->due(seconds())) checkpointer_->write(snapshot(), ledger_);
        if (!watch().expired()) return;
        if (checkpointer_) keep_stopped(snapshot(false));
        throw Stopped{watch().reason()};
    }
    bool is_kept() const { return checkpointer_ != nullptr; } ///< whether the run writes checkpoints
    /// Writes an earlier snapshot as a checkpoint if a checkpoint is due.
    void keep_as(const Snapshot<Genome>& before) {
        if (checkpointer_ && checkpointer_->due(seconds())) checkpointer_->write(before, ledger_);
    }
    /// The current state of the run between two stages, with or without its frames.
    [[gnu::cold]] Snapshot<Genome> snapshot(bool with_frames = true) const {
        return {state,
                with_frames ? state.frames : std::list<Frame<Genome>>(),
                ledger_.counters,
                seconds(),
                ledger_.memory.young.size(),
                ledger_.heaviest()};
    }
    /// Continues from a snapshot: blocks find their frames in it when they open.
    [[gnu::cold]] void resume(Snapshot<Genome> snapshot) {
        state.saved = std::move(snapshot.frames);
        state.earlier_seconds = snapshot.seconds;
        ledger_.counters = snapshot.counters;
        ledger_.resume(snapshot.heaviest);
        static_cast<Progress<Genome>&>(state) = std::move(snapshot);
    }
    /// Writes the checkpoint of a stopping run, once. `before` is the state before the interrupted stage or
    /// between two stages. The frames of the open blocks are added to it.
    [[gnu::cold]] void keep_stopped(Snapshot<Genome> before) {
        if (std::exchange(stop_kept_, true)) return;
        before.frames = state.frames;
        checkpointer_->write(before, ledger_);
    }
    /// Time since the run began, in all its processes.
    double seconds() const { return state.earlier_seconds + watch().seconds(); }

    /// Counts work that was done outside evaluations. It does not end the run.
    void charge(std::span<const Work> done) {
        EvaluationRequest<P> request;
        for (const Work& one : done) request.work += one.price;
        EvaluationRequest<P>* const requests[] = {&request};
        if (request.work > 0) queue_.serve(std::span<EvaluationRequest<P>* const>(requests));
    }

  private:
    using Requested = typename EvaluationRequest<P>::OutcomeRequest;
    struct Shown {
        std::string path;
        std::vector<std::size_t> generation;
        Population<Genome> population;
        Counters counters;
        double seconds;
    };

    /// Offers the best of those individuals that have the most replicates; feasible ones first. It replaces
    /// the stored one, unless that has as many replicates and is better.
    void offer_surest(std::initializer_list<const Population<Genome>*> populations) {
        const auto rank = [](const Fitness& fitness) { return std::pair(fitness.feasible(), fitness.replicates()); };
        const Individual<Genome>* surest = nullptr;
        for (const auto* population : populations)
            for (const auto& individual : *population) {
                const Fitness& fitness = individual.fitness;
                if (!fitness.known(names_[0]) || fitness.has_failed()) continue;
                if (!surest || rank(fitness) > rank(surest->fitness) ||
                    (rank(fitness) == rank(surest->fitness) && better(fitness, surest->fitness)))
                    surest = &individual;
            }
        auto& best = root_.state.best;
        if (surest &&
            (!best || rank(best->fitness) < rank(surest->fitness) ||
             (best->fitness.feasible() == surest->fitness.feasible() && !better(best->fitness, surest->fitness))))
            best = *surest;
    }
    void report(const Event<Genome>& event) const {
        for (const auto& observer : observers_) observer(event);
    }
    /// Makes the requested evaluations. If the run has to stop, stores this population as its result and
    /// throws Stopped.
    void serve(const Population<Genome>& population) {
        request_.generation = position.generations();
        try {
            queue_.serve(request_);
        } catch (const Stopped&) {
            state.stopped_population = population;
            throw;
        }
    }
    /// The mean of some answers; none if one is missing.
    std::optional<Fitness> mean_of(std::span<const Requested> replicates, std::size_t which) const {
        const auto& objective = problem().objectives()[which];
        const auto n = static_cast<double>(replicates.size());
        double value = 0;
        std::vector<double> violations;
        for (const Requested& replicate : replicates) {
            if (!replicate.is_answered()) return std::nullopt;
            const Fitness one = fitness_of(problem(), *replicate.answer, objective, names_[which]);
            if (one.has_failed()) return one;
            value += one.value() / n;
            violations.resize(std::max(violations.size(), one.violations().size()), 0);
            for (std::size_t k = 0; k < one.violations().size(); ++k) violations[k] += one.violations()[k] / n;
        }
        return Fitness(names_[which], value, objective.minimise)
            .constrained(std::move(violations))
            .averaged(replicates.size());
    }

    Ledger<P>& ledger_;
    EvaluationQueue<P>& queue_;
    Context& root_;
    std::vector<Observer<Genome>> observers_;
    Checkpointer<P>* checkpointer_ = nullptr;
    std::size_t population_bytes_;
    std::vector<Name> names_; ///< names of the problem's objectives
    EvaluationRequest<P> request_;
    std::vector<Individual<Genome>*> requested_;
    Population<Genome> spare_;
    std::vector<Shown> shown_;
    bool stop_kept_ = false;
};

} // namespace ga
