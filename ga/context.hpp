#pragma once

#include "ga/demand.hpp"
#include "ga/evaluator.hpp"

#include <deque>

namespace ga {

/// What an observer sees after a stage.
template <class G>
struct Event {
    const std::string& path;             ///< where the stage stands, e.g. "sog/refine.2"
    std::vector<std::size_t> generation; ///< of each enclosing repeat, outermost first, from 0
    const Population<G>& population;     ///< as the stage left it
    const Counters& counters;            ///< what the run has paid for so far
    double seconds;                      ///< since the run began
};

/// Called after every stage, on the thread that runs the pipeline.
template <class G>
using Observer = std::function<void(const Event<G>&)>;

/// All that a block of stages must know to go on from where it stands. The frames of the blocks that are open
/// are the whole state of a run, so a checkpoint is their list.
template <class G>
struct Frame {
    std::size_t next = 0;            ///< the block's own count: the stage or generation to come
    Population<G> population;        ///< on its way through the block
    std::vector<Population<G>> kept; ///< populations the block holds aside
    std::vector<double> numbers;     ///< numbers the block holds aside
};

/// A run between two stages: all it needs to go on.
template <class G>
struct Snapshot {
    std::deque<Frame<G>> frames;       ///< of the open blocks, outermost first; empty when the run is done
    Counters counters;                 ///< paid for so far
    Identity next_identity = 0;        ///< the next child's
    std::optional<Individual<G>> best; ///< under the problem's first objective
    std::vector<std::string> notes;    ///< remarks so far
    double seconds = 0;                ///< spent so far, in all the processes that carried the run
    std::size_t remembered = 0;        ///< how many evaluations of the memory's young half were known then
};

template <Problem P>
class Context;

/// Keeps a run on its way so that it can go on after its process has ended.
template <Problem P>
class Keeper {
  public:
    using Genome = typename P::Genome; ///< of the problem

    virtual ~Keeper() = default;
    /// Called before the pipeline starts: lets the context go on from what was kept of the run with this
    /// identity, if anything was. Gives the pipeline's answer when that run had ended already.
    virtual std::optional<Population<Genome>> begin(Context<P>& context, std::uint64_t run) = 0;
    /// Called between two stages; writes the run down if it is time to.
    virtual void pause(const Context<P>& context) = 0;
    /// Called when the run is stopped, with the last moment between two stages.
    virtual void stop(const Snapshot<Genome>& snapshot, const Evaluator<P>& evaluator) = 0;
    /// Called with the pipeline's answer.
    virtual void finish(const Context<P>& context, const Population<Genome>& answer) = 0;
};

/// What stages share while a pipeline runs: the evaluator, random streams keyed by where a stage stands, the
/// identities, the best so far, and the observers. One for each run, passed down, never global.
template <Problem P>
class Context {
  public:
    using Genome = typename P::Genome;   ///< of the problem
    using Outcome = typename P::Outcome; ///< of the problem's evaluations

    /// @param variant        first word of every path
    /// @param seed           of every random stream
    /// @param next_identity  greater than any in the population
    Context(Evaluator<P>& evaluator, std::string variant, std::uint64_t seed, Identity next_identity,
            std::vector<Observer<Genome>> observers)
        : evaluator_(evaluator), next_identity_(next_identity), observers_(std::move(observers)) {
        for (const auto& objective : problem().objectives())
            names_.push_back(Name(objective.name));
        const std::uint64_t key = fold(0, seed);
        places_.push_back({Name(variant), 0, key, key, {}});
    }
    Context(const Context&) = delete;

    const P& problem() const { return evaluator_.problem(); }    ///< what is solved
    Evaluator<P>& evaluator() { return evaluator_; }             ///< which makes the paid calls
    const Evaluator<P>& evaluator() const { return evaluator_; } ///< the same, to read
    Counters& counters() { return evaluator_.counters; }         ///< paid for so far
    int threads() const { return evaluator_.threads(); }         ///< to work with; decides no result

    /// Random numbers for the index-th piece of work of the stage that runs, in this generation.
    Stream stream(std::size_t index) const { return Stream(fold(places_.back().key, index)); }
    /// The identity of a new individual.
    Identity new_identity() { return next_identity_++; }

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
                individual.fitness = Evaluator<P>::judge(evaluation, objective, name);
                return !individual.fitness.has_failed();
            },
            patience);
    }
    /// Calls judge(individual, evaluation) for every individual, evaluating where needed; judge sets the
    /// fitness and is false when that has failed.
    template <class Judge>
    void evaluate(Population<Genome>& population, Judge judge) {
        visit(
            population, [](const auto&) { return true; }, judge, Patience::none);
    }

    /// Remembers the individual if it is the best so far under the problem's first objective.
    void offer(const Individual<Genome>& individual) {
        if (individual.fitness.known(names_[0]) && !individual.fitness.has_failed() &&
            (!best_ || individual.value() > best_->value()))
            best_ = individual;
    }
    /// None until something was scored.
    const std::optional<Individual<Genome>>& best() const { return best_; }

    /// Whether `score` may leave out whom the stage after it would not keep anyway.
    void screen(bool on) { screens_ = on; }
    /// What the stage after the one that runs will keep.
    void expect(std::optional<Demand> demand) { demand_ = std::move(demand); }
    /// The same, where the run may make use of it.
    std::optional<Demand> demand() const { return screens_ ? demand_ : std::nullopt; }

    /// Notes how many `score` left out of the population that the stage after it gets.
    void leave_out(std::size_t count) {
        left_out_ = count;
        counters().given_up += static_cast<long>(count);
    }
    std::size_t left_out() const { return left_out_; } ///< by the last `score`

    /// A remark for the run's result, under the path of the stage that runs.
    void note(const std::string& text) { notes_.push_back(path() + ": " + text); }
    /// In the order they were made, each under its path.
    const std::vector<std::string>& notes() const { return notes_; }

    /// The place of the stage that runs: the enclosing blocks, then its name with its ordinal among equal
    /// names.
    std::string path() const {
        std::string path;
        for (const Place& place : places_) {
            path += (path.empty() ? "" : "/") + place.name.text();
            if (place.ordinal > 0)
                path += "." + std::to_string(place.ordinal);
        }
        return path;
    }

    /// Stands on a place of the pipeline while it lives. Ordinal 0 is not shown.
    class Scope {
      public:
        /// Enters the place of that name.
        Scope(Context& context, Name name, std::size_t ordinal) : context_(context) {
            const std::uint64_t key = fold(fold(context.places_.back().inner, name.text()), ordinal);
            context.places_.push_back({name, ordinal, key, key, {}});
        }
        Scope(const Scope&) = delete;
        ~Scope() { context_.places_.pop_back(); }

      private:
        Context& context_;
    };
    /// Counts a pass through the block that runs while it lives: stages inside draw other random numbers in
    /// each.
    class Round {
      public:
        /// Begins pass `number`, from 0.
        Round(Context& context, std::size_t number) : context_(context) {
            Place& place = context.places_.back();
            place.generation = number;
            place.inner = fold(place.key, number);
        }
        Round(const Round&) = delete;
        ~Round() {
            context_.places_.back().generation.reset();
            context_.places_.back().inner = context_.places_.back().key;
        }

      private:
        Context& context_;
    };
    /// A round whose stages may read what is kept of its start.
    class Generation : Round {
      public:
        /// `start`, which must outlive it, is what stages may read.
        Generation(Context& context, std::size_t number, const Population<Genome>& start)
            : Round(context, number), context_(context) {
            context.starts_.push_back(&start);
        }
        ~Generation() { context_.starts_.pop_back(); }

      private:
        Context& context_;
    };

    /// Holds a block's frame while it lives: a new one, or the saved one when a run is resumed.
    class OpenFrame {
      public:
        /// Opens it with the population to begin with; a resumed frame brings its own.
        OpenFrame(Context& context, Population<Genome> population) : context_(context) {
            const std::size_t depth = context.frames_.size();
            resumed_ = depth < context.saved_.size();
            if (resumed_) {
                context.frames_.push_back(std::move(context.saved_[depth]));
                if (depth + 1 == context.saved_.size())
                    context.saved_.clear();
            } else {
                context.frames_.push_back({});
                context.frames_.back().population = std::move(population);
            }
            frame_ = &context.frames_.back();
        }
        OpenFrame(const OpenFrame&) = delete;
        ~OpenFrame() { context_.frames_.pop_back(); }
        /// The frame.
        Frame<Genome>* operator->() { return frame_; }
        /// The frame.
        Frame<Genome>& operator*() { return *frame_; }
        /// Whether the block goes on from a checkpoint.
        bool resumed() const { return resumed_; }

      private:
        Context& context_;
        Frame<Genome>* frame_;
        bool resumed_;
    };

    /// The best of the population at the start of the innermost generation, as many as `elite` and `plus`
    /// read.
    const Population<Genome>& generation_start() const { return *starts_.back(); }

    /// Shows the observers what the stage that runs has made.
    void show(const Population<Genome>& population) {
        if (observers_.empty())
            return;
        const std::string where = path();
        std::vector<std::size_t> generation;
        for (const Place& place : places_)
            if (place.generation)
                generation.push_back(*place.generation);
        for (const auto& observer : observers_)
            observer({where, generation, population, evaluator_.counters, seconds()});
    }
    /// A moment between two stages, at which a run may end or be written down.
    void pause() {
        if (keeper_)
            keeper_->pause(*this);
        if (!evaluator_.watch().expired())
            return;
        if (keeper_)
            keep_stopped(snapshot(false));
        throw Stopped{evaluator_.watch().reason()};
    }

    /// Lets a keeper follow the run; before the pipeline is started.
    void keep(Keeper<P>& keeper) { keeper_ = &keeper; }
    bool kept() const { return keeper_ != nullptr; } ///< whether somebody keeps it
    /// The run as it is now, between two stages, with or without the frames' populations.
    Snapshot<Genome> snapshot(bool with_frames = true) const {
        return {with_frames ? frames_ : std::deque<Frame<Genome>>(),
                evaluator_.counters,
                next_identity_,
                best_,
                notes_,
                earlier_seconds_ + evaluator_.watch().seconds(),
                evaluator_.memory().young().size()};
    }
    /// Goes on from a snapshot: blocks that open find their frames in it.
    void resume(Snapshot<Genome> snapshot) {
        saved_ = std::move(snapshot.frames);
        evaluator_.counters = snapshot.counters;
        next_identity_ = snapshot.next_identity;
        best_ = std::move(snapshot.best);
        notes_ = std::move(snapshot.notes);
        earlier_seconds_ = snapshot.seconds;
        evaluator_.resume(best_.has_value());
    }
    /// Hands the keeper a run that stopped inside a stage, as it was before that stage; the innermost block
    /// knows.
    void keep_stopped(Snapshot<Genome> before) {
        if (std::exchange(stop_kept_, true))
            return;
        before.frames = frames_;
        keeper_->stop(before, evaluator_);
    }
    /// Since the run began, in all the processes that carried it.
    double seconds() const { return earlier_seconds_ + evaluator_.watch().seconds(); }

  private:
    template <class Wanted, class Judge>
    void visit(Population<Genome>& population, Wanted wanted, Judge judge, Patience patience) {
        evaluator_.visit(
            population, wanted,
            [&](auto& individual, const Evaluation<Outcome>& evaluation) {
                if (!judge(individual, evaluation))
                    ++counters().failures;
                else if constexpr (Settling<P>)
                    individual.genome = problem().settled(individual.genome, std::get<Outcome>(evaluation));
                offer(individual);
            },
            patience);
    }

    struct Place {
        Name name;
        std::size_t ordinal;
        std::uint64_t key;   ///< of the stage's own random numbers
        std::uint64_t inner; ///< of the stages inside it
        std::optional<std::size_t> generation;
    };

    Evaluator<P>& evaluator_;
    Identity next_identity_;
    std::vector<Observer<Genome>> observers_;
    std::vector<Name> names_; ///< of the problem's objectives, same order
    std::vector<Place> places_;
    std::deque<Frame<Genome>> frames_;
    std::deque<Frame<Genome>> saved_;
    std::vector<const Population<Genome>*> starts_;
    Population<Genome> spare_;
    std::optional<Individual<Genome>> best_;
    std::vector<std::string> notes_;
    Keeper<P>* keeper_ = nullptr;
    std::optional<Demand> demand_;
    bool screens_ = false;
    std::size_t left_out_ = 0;
    double earlier_seconds_ = 0;
    bool stop_kept_ = false;
};

} // namespace ga
