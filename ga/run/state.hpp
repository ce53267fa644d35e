#pragma once

#include "ga/run/ledger.hpp"

#include <nlohmann/json_fwd.hpp>

#include <any>
#include <charconv>
#include <list>
#include <map>

namespace ga {

/// The stage that runs: its path, its random streams and its generation. A stream's key depends only on the
/// seed, the path without the variant's name, the generation and an index.
template <class G>
class StagePosition {
  public:
    /// The position before the first stage. `variant` is the first word of every path; `seed` is part of the
    /// key of every random stream.
    StagePosition(const std::string& variant, std::uint64_t seed) {
        const std::uint64_t key = fold(0, seed);
        path_.push_back({Name(variant), 0, key, key, {}});
    }

    /// Random numbers for the index-th task of the current stage, in this generation.
    Stream stream(std::size_t index) const { return Stream(fold(path_.back().key, index)); }

    /// The path of the stage: the enclosing blocks, then its name with its ordinal among stages of this name.
    std::string path() const {
        std::string path;
        for (const PathElement& element : path_) {
            path += (path.empty() ? "" : "/") + element.name.text();
            if (element.ordinal > 0) path += "." + std::to_string(element.ordinal);
        }
        return path;
    }
    /// The generation of each enclosing block, outermost first, from 0.
    std::vector<std::size_t> generations() const {
        std::vector<std::size_t> generations;
        for (const PathElement& element : path_)
            if (element.generation) generations.push_back(*element.generation);
        return generations;
    }
    /// The best individuals of the innermost generation's first population, as many as its stages read: five
    /// for `elite 5`, all for `plus`. The stage `epsilon` changes their fitness.
    Population<G>& generation_start() const { return *starts_.back(); }
    bool has_start() const { return !starts_.empty(); } ///< whether there is a generation's start

    /// Makes a stage the current one as long as this object exists.
    class Scope {
      public:
        /// Enters the stage of that name. Paths show its ordinal if it is above 0.
        Scope(StagePosition& position, Name name, std::size_t ordinal) : position_(position) {
            const std::uint64_t key = fold(fold(position.path_.back().inner, name.text()), ordinal);
            position.path_.push_back({name, ordinal, key, key, {}});
        }
        Scope(const Scope&) = delete;
        ~Scope() { position_.path_.pop_back(); }

      private:
        StagePosition& position_;
    };
    /// Marks one pass through the current block as long as this object exists. In each pass the stages inside
    /// draw different random numbers.
    class Round {
      public:
        /// Begins pass `number`, from 0. `start` is the generation's start and must outlive this object. If
        /// it is null, stages use the enclosing block's start.
        Round(StagePosition& position, std::size_t number, Population<G>* start = nullptr)
            : position_(position), has_start_(start != nullptr) {
            PathElement& element = position.path_.back();
            element.generation = number;
            element.inner = fold(element.key, number);
            if (has_start_) position.starts_.push_back(start);
        }
        Round(const Round&) = delete;
        ~Round() {
            position_.path_.back().generation.reset();
            position_.path_.back().inner = position_.path_.back().key;
            if (has_start_) position_.starts_.pop_back();
        }

      private:
        StagePosition& position_;
        bool has_start_;
    };

  private:
    struct PathElement {
        Name name;
        std::size_t ordinal;
        std::uint64_t key;   ///< key of the stage's random numbers
        std::uint64_t inner; ///< key of the stages inside it
        std::optional<std::size_t> generation;
    };

    std::vector<PathElement> path_;
    std::vector<Population<G>*> starts_;
};

/// The state of an operator, e.g. the step sizes of `cma-es`. Its type may be any S that to_json writes and
/// from_json reads without loss. Copies are independent of each other.
class OperatorState {
    using Stored = std::shared_ptr<const nlohmann::json>;

  public:
    OperatorState() = default;
    /// A state as JSON from a checkpoint. The first call of as() converts it to the operator's type.
    explicit OperatorState(Stored stored) : value_(std::move(stored)) {}

    /// The state as type S. The first call creates it or reads the stored state. Throws UsageError if the
    /// checkpoint stores another type.
    template <class S>
    S& as() {
        if (S* known = std::any_cast<S>(&value_)) return *known;
        S made{};
        if (const Stored* stored = std::any_cast<Stored>(&value_)) try {
                from_json(**stored, made);
            } catch (const std::exception&) {
                expect_fit(false);
            }
        write_ = [](const std::any& value, nlohmann::json& j) { to_json(j, *std::any_cast<S>(&value)); };
        return value_.emplace<S>(std::move(made));
    }
    /// Writes the state in the format of a checkpoint.
    template <class Json>
    void write(Json& j) const {
        if (const Stored* stored = std::any_cast<Stored>(&value_))
            j = **stored;
        else
            write_(value_, j);
    }

  private:
    std::any value_;
    void (*write_)(const std::any&, nlohmann::json&) = nullptr;
};

/// Reads the parts of a value, in order, from the array that its to_json has written. Throws nlohmann's
/// exceptions if one does not fit.
template <class Json, class... Parts>
void read_parts(const Json& j, Parts&... parts) {
    std::size_t i = 0;
    (j.at(i++).get_to(parts), ...);
}

/// A stage's result, as observers see it.
template <class G>
struct Event {
    const std::string& path;             ///< path of the stage, e.g. "sog/refine.2"
    std::vector<std::size_t> generation; ///< generation of each enclosing `repeat`, outermost first, from 0
    const Population<G>& population;     ///< population that the stage returned
    const Counters& counters;            ///< evaluations that the run has spent so far
    double seconds;                      ///< time since the run began, s
    bool derived = false;                ///< whether the stage ran under a derived problem (run_derived)
};

/// A function that is called after every stage, on the thread that runs the pipeline. The stages that run on
/// islands are reported at the end of each round, island by island.
template <class G>
using Observer = std::function<void(const Event<G>&)>;

/// The values that a block of stages needs to continue from its current point. The frames of all open blocks determine
/// the point at which a run continues. A checkpoint contains them and the other members of Snapshot.
template <class G>
struct Frame {
    std::size_t next = 0;                        ///< index of the block's next stage or generation
    Population<G> population;                    ///< the current population at this point
    std::vector<Population<G>> kept;             ///< populations that the block stores
    std::vector<std::vector<double>> numbers;    ///< numbers that the block and its rules store
    std::map<std::string, OperatorState> states; ///< states of the operators inside, by path
};

/// The part of a run's state that stages change and checkpoints store.
template <class G>
struct Progress {
    Identity next_identity = 0;             ///< identity of the next new individual
    std::optional<Individual<G>> best = {}; ///< best individual under the problem's first objective
    std::vector<std::string> notes = {};    ///< remarks, in the order they were made
    double idle_generations = 0;            ///< generations, of any block, since an evaluation was requested
};

/// The state of a run between two stages, from which it can continue.
template <class G>
struct Snapshot : Progress<G> {
    std::list<Frame<G>> frames; ///< one per open block, outermost first; empty if the run is done
    Counters counters;          ///< evaluations spent so far
    double seconds = 0;         ///< time spent so far in all processes of the run, s
    std::size_t remembered = 0; ///< number of evaluations in the newer half of the memory
    std::size_t heaviest = 0;   ///< bytes of the largest outcome or failure message so far
};

/// The state of a run that stages change. When a run has to stop, its population is stored here too.
template <class G>
class RunState : public Progress<G> {
  public:
    using Progress<G>::notes;

    /// @param next  the first new individual's identity; greater than any in the population
    /// @param step  difference of two successive identities
    explicit RunState(Identity next, Identity step = 1) : Progress<G>{next}, identity_step(step) {}

    Identity identity_step;                          ///< difference of two successive identities
    std::list<Frame<G>> frames;                      ///< one per open block, outermost first
    std::list<Frame<G>> saved;                       ///< frames of blocks that will open again after a resume
    std::vector<Frame<G>*> loops;                    ///< frames of blocks whose stages run repeatedly
    std::optional<Population<G>> stopped_population; ///< the population of a run that has to stop
    double earlier_seconds = 0;                      ///< time spent in earlier processes of the run, s

    /// Adds a remark; after the first hundred they are only counted.
    void note(std::string text) {
        if (notes.size() < max_notes) return notes.push_back(std::move(text));
        if (notes.size() == max_notes) notes.emplace_back();
        const std::string& last = notes.back(); // "and N more remarks", from which a resumed run reads N
        std::size_t more = 0;
        std::from_chars(last.data() + std::min<std::size_t>(4, last.size()), last.data() + last.size(), more);
        notes.back() = "and " + std::to_string(more + 1) + " more remarks";
    }

    /// Keeps a block's frame as long as this object exists: a new frame, or the saved one of a resumed run.
    class OpenFrame {
      public:
        /// Opens a frame with `population`. A resumed frame keeps its stored population instead. `loops` is
        /// true if the block runs its stages repeatedly.
        OpenFrame(RunState& run, Population<G> population, bool loops = false) : run_(run), loops_(loops) {
            const std::size_t depth = run.frames.size();
            resumed_ = depth < run.saved.size();
            if (resumed_) {
                run.frames.push_back(std::move(*std::next(run.saved.begin(), static_cast<long>(depth))));
                if (depth + 1 == run.saved.size()) run.saved.clear();
            } else {
                run.frames.push_back({});
                run.frames.back().population = std::move(population);
            }
            frame_ = &run.frames.back();
            if (loops) run.loops.push_back(frame_);
        }
        OpenFrame(const OpenFrame&) = delete;
        ~OpenFrame() {
            if (loops_) run_.loops.pop_back();
            run_.frames.pop_back();
        }
        Frame<G>* operator->() { return frame_; } ///< the frame
        Frame<G>& operator*() { return *frame_; } ///< the frame
        bool resumed() const { return resumed_; } ///< whether the block continues from a checkpoint

      private:
        RunState& run_;
        Frame<G>* frame_;
        bool loops_, resumed_;
    };

  private:
    static constexpr std::size_t max_notes = 100;
};

/// Saves a run while it proceeds, so that it can be resumed after its process has ended.
template <Problem P>
class Checkpointer {
  public:
    using Genome = typename P::Genome; ///< genome of the problem
    using Taken = Snapshot<Genome>;    ///< a run between two stages

    virtual ~Checkpointer() = default;
    /// Called with the run's identity before the pipeline starts. Returns the stored run, if there is one,
    /// and restores the ledger's memory.
    virtual std::optional<Taken> begin(Ledger<P>& ledger, std::uint64_t run) = 0;
    /// The pipeline's answer, if the run that `begin` found had already ended.
    virtual std::optional<Population<Genome>> answer() const = 0;
    /// Whether it is time to write the run, `seconds` after it began.
    virtual bool due(double seconds) const = 0;
    /// Writes the run. `answer` is given when the run is done.
    virtual void write(const Taken& snapshot, const Ledger<P>& ledger, const Population<Genome>* answer = nullptr) = 0;
    /// The writes that failed, in words; empty if all writes succeeded.
    virtual std::string trouble() const { return {}; }
};

} // namespace ga
