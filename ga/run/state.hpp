#pragma once

#include "ga/run/ledger.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>

namespace ga {

/// Where a run stands: the path of the stage, its random streams, its generation. Streams are keyed by the
/// seed, the path without the variant's own name, the generation and an index, and by nothing else.
template <class G>
class StagePosition {
  public:
    /// At the root. `variant` is the first word of every path, `seed` that of every stream.
    StagePosition(const std::string& variant, std::uint64_t seed) {
        const std::uint64_t key = fold(0, seed);
        places_.push_back({Name(variant), 0, key, key, {}});
    }

    /// Random numbers for the index-th piece of work of the stage that runs, in this generation.
    Stream stream(std::size_t index) const { return Stream(fold(places_.back().key, index)); }

    /// The enclosing blocks, then the stage's name with its ordinal among equal names.
    std::string path() const {
        std::string path;
        for (const Place& place : places_) {
            path += (path.empty() ? "" : "/") + place.name.text();
            if (place.ordinal > 0)
                path += "." + std::to_string(place.ordinal);
        }
        return path;
    }
    /// Of each enclosing block of generations, outermost first, from 0.
    std::vector<std::size_t> generations() const {
        std::vector<std::size_t> generations;
        for (const Place& place : places_)
            if (place.generation)
                generations.push_back(*place.generation);
        return generations;
    }
    /// Of the innermost block of generations, from 0; 0 outside any.
    std::size_t generation() const {
        for (auto place = places_.rbegin(); place != places_.rend(); ++place)
            if (place->generation)
                return *place->generation;
        return 0;
    }
    /// The best of the population at the start of the innermost generation, as many as `elite` and `plus`
    /// read; `epsilon` changes their fitness.
    Population<G>& generation_start() const { return *starts_.back(); }

    /// Stands on a place of the pipeline while it lives. Ordinal 0 is not shown.
    class Scope {
      public:
        /// Enters the place of that name.
        Scope(StagePosition& where, Name name, std::size_t ordinal) : where_(where) {
            const std::uint64_t key = fold(fold(where.places_.back().inner, name.text()), ordinal);
            where.places_.push_back({name, ordinal, key, key, {}});
        }
        Scope(const Scope&) = delete;
        ~Scope() { where_.places_.pop_back(); }

      private:
        StagePosition& where_;
    };
    /// Counts a pass through the block that runs while it lives: stages inside draw other random numbers in
    /// each.
    class Round {
      public:
        /// Begins pass `number`, from 0.
        Round(StagePosition& where, std::size_t number) : where_(where) {
            Place& place = where.places_.back();
            place.generation = number;
            place.inner = fold(place.key, number);
        }
        Round(const Round&) = delete;
        ~Round() {
            where_.places_.back().generation.reset();
            where_.places_.back().inner = where_.places_.back().key;
        }

      private:
        StagePosition& where_;
    };
    /// A round whose stages may read what is kept of its start.
    class Generation : Round {
      public:
        /// `start`, which must outlive it, is what stages may read.
        Generation(StagePosition& where, std::size_t number, Population<G>& start)
            : Round(where, number), where_(where) {
            where.starts_.push_back(&start);
        }
        ~Generation() { where_.starts_.pop_back(); }

      private:
        StagePosition& where_;
    };

  private:
    struct Place {
        Name name;
        std::size_t ordinal;
        std::uint64_t key;   ///< of the stage's own random numbers
        std::uint64_t inner; ///< of the stages inside it
        std::optional<std::size_t> generation;
    };

    std::vector<Place> places_;
    std::vector<Population<G>*> starts_;
};

/// The state of an operator, whatever its type, as checkpoints and copies of a run handle it.
class AnyState {
  public:
    virtual ~AnyState() = default;
    virtual std::unique_ptr<AnyState> clone() const = 0; ///< a copy
    virtual void write(nlohmann::json& j) const = 0;     ///< as a checkpoint holds it
    virtual const nlohmann::json* stored() const {
        return nullptr;
    } ///< where it was read and not yet understood
};

/// A state of type S, which to_json and from_json write and read without loss.
template <class S>
class StateOf : public AnyState {
  public:
    S value{}; ///< the state

    std::unique_ptr<AnyState> clone() const override { return std::make_unique<StateOf>(*this); }
    void write(nlohmann::json& j) const override { to_json(j, value); }
};

/// A state that is copied with what holds it.
class HeldState {
  public:
    HeldState() = default;
    /// Takes a state.
    explicit HeldState(std::unique_ptr<AnyState> state) : state_(std::move(state)) {}
    /// A copy of its own.
    HeldState(const HeldState& other) : state_(other.state_ ? other.state_->clone() : nullptr) {}
    HeldState(HeldState&&) = default; ///< takes the other's
    /// A copy of its own.
    HeldState& operator=(HeldState other) {
        state_ = std::move(other.state_);
        return *this;
    }
    const AnyState& operator*() const { return *state_; } ///< the state

    /// The state as an S: new where there was none, understood where it was read from a checkpoint. Throws
    /// UsageError where what was read is no S.
    template <class S>
    S& as() {
        if (auto* own = dynamic_cast<StateOf<S>*>(state_.get()))
            return own->value;
        auto made = std::make_unique<StateOf<S>>();
        if (state_ && state_->stored())
            try {
                from_json(*state_->stored(), made->value);
            } catch (const std::exception&) { // the reader's words help nobody
                expect_fit(false);
            }
        S& value = made->value;
        state_ = std::move(made);
        return value;
    }

  private:
    std::unique_ptr<AnyState> state_;
};

/// What an observer sees after a stage.
template <class G>
struct Event {
    const std::string& path;             ///< where the stage stands, e.g. "sog/refine.2"
    std::vector<std::size_t> generation; ///< of each enclosing repeat, outermost first, from 0
    const Population<G>& population;     ///< as the stage left it
    const Counters& counters;            ///< what the run has paid for so far
    double seconds;                      ///< since the run began
    bool derived = false;                ///< under a problem derived from the run's own (run_derived)
};

/// Called after every stage, on the thread that runs the pipeline; for islands after their round, one island
/// after the other.
template <class G>
using Observer = std::function<void(const Event<G>&)>;

/// All that a block of stages must know to go on from where it stands. The frames of the blocks that are open
/// are the whole state of a run, so a checkpoint is their list.
template <class G>
struct Frame {
    std::size_t next = 0;                     ///< the block's own count: the stage or generation to come
    Population<G> population;                 ///< on its way through the block
    std::vector<Population<G>> kept;          ///< populations the block holds aside
    std::vector<std::vector<double>> numbers; ///< numbers the block and its rules hold aside
    std::map<std::string, HeldState> states;  ///< of the operators inside, by their path
};

/// A run between two stages: all it needs to go on.
template <class G>
struct Snapshot {
    std::list<Frame<G>> frames;        ///< of the open blocks, outermost first; empty when the run is done
    Counters counters;                 ///< paid for so far
    Identity next_identity = 0;        ///< the next child's
    std::optional<Individual<G>> best; ///< under the problem's first objective
    std::vector<std::string> notes;    ///< remarks so far
    double seconds = 0;                ///< spent so far, in all the processes that carried the run
    std::size_t remembered = 0;        ///< how many evaluations of the memory's young half were known then
    std::size_t heaviest = 0;          ///< bytes of the largest outcome or reason then
};

/// What a run needs to be resumed: the frames of open blocks, the identities given out, the best so far,
/// the notes, and what was in hand when it had to stop.
template <class G>
class RunState {
  public:
    /// @param next  the first new individual's identity; greater than any in the population
    /// @param step  between two identities given out
    explicit RunState(Identity next, Identity step = 1) : next_identity(next), identity_step(step) {}

    Identity next_identity;               ///< the next new individual's
    Identity identity_step;               ///< from one to the next
    std::list<Frame<G>> frames;           ///< of the open blocks, outermost first
    std::list<Frame<G>> saved;            ///< of blocks that will open again after a resume
    std::vector<Frame<G>*> loops;         ///< of those whose stages run again and again
    std::optional<Individual<G>> best;    ///< under the problem's first objective
    std::optional<Population<G>> in_hand; ///< of a run that has to stop
    double earlier_seconds = 0;           ///< of the processes before this one

    /// A remark; after the first hundred they are counted alone.
    void note(std::string text) {
        if (notes_.size() < most_notes)
            notes_.push_back(std::move(text));
        else
            ++more_notes_;
    }
    /// In the order they were made.
    std::vector<std::string> notes() const {
        std::vector<std::string> all = notes_;
        if (more_notes_ > 0)
            all.push_back("and " + std::to_string(more_notes_) + " more remarks");
        return all;
    }
    /// Takes up the notes of a run that goes on.
    void resume_notes(std::vector<std::string> notes) { notes_ = std::move(notes); }

    /// Holds a block's frame while it lives: a new one, or the saved one when a run is resumed.
    class OpenFrame {
      public:
        /// Opens it with the population to begin with; a resumed frame brings its own.
        OpenFrame(RunState& kept, Population<G> population, bool loops = false) : kept_(kept), loops_(loops) {
            const std::size_t depth = kept.frames.size();
            resumed_ = depth < kept.saved.size();
            if (resumed_) {
                kept.frames.push_back(std::move(*std::next(kept.saved.begin(), static_cast<long>(depth))));
                if (depth + 1 == kept.saved.size())
                    kept.saved.clear();
            } else {
                kept.frames.push_back({});
                kept.frames.back().population = std::move(population);
            }
            frame_ = &kept.frames.back();
            if (loops)
                kept.loops.push_back(frame_);
        }
        OpenFrame(const OpenFrame&) = delete;
        ~OpenFrame() {
            if (loops_)
                kept_.loops.pop_back();
            kept_.frames.pop_back();
        }
        Frame<G>* operator->() { return frame_; } ///< the frame
        Frame<G>& operator*() { return *frame_; } ///< the frame
        bool resumed() const { return resumed_; } ///< whether the block goes on from a checkpoint

      private:
        RunState& kept_;
        Frame<G>* frame_;
        bool loops_, resumed_;
    };

  private:
    static constexpr std::size_t most_notes = 100;

    std::vector<std::string> notes_;
    std::size_t more_notes_ = 0;
};

/// Keeps a run on its way so that it can go on after its process has ended.
template <Problem P>
class Checkpointer {
  public:
    using Genome = typename P::Genome; ///< of the problem
    using Taken = Snapshot<Genome>;    ///< a run between two stages

    virtual ~Checkpointer() = default;
    /// Called before the pipeline starts, with the run's identity: what was kept of it, if anything was; the
    /// ledger gets its memory back.
    virtual std::optional<Taken> begin(Ledger<P>& ledger, std::uint64_t run) = 0;
    /// The pipeline's answer, when the run that `begin` found had ended already.
    virtual std::optional<Population<Genome>> answer() const = 0;
    /// Whether it is time to write the run down, so many seconds after it began.
    virtual bool due(double seconds) const = 0;
    /// Writes the run down; with its answer when it is done.
    virtual void write(const Taken& snapshot, const Ledger<P>& ledger,
                       const Population<Genome>* answer = nullptr) = 0;
    /// What could not be kept, in words; empty when all was.
    virtual std::string trouble() const { return {}; }
};

} // namespace ga
