#pragma once

#include "ga/budget.hpp"
#include "ga/individual.hpp"
#include "ga/state.hpp"

#include <functional>
#include <list>
#include <map>
#include <optional>

namespace ga {

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
};

/// What is kept of a run on its way: the frames of open blocks, the identities given out, the best so far,
/// the notes, and what was in hand when it had to stop.
template <class G>
class Kept {
  public:
    /// @param next  the first new individual's identity; greater than any in the population
    /// @param step  between two identities given out
    explicit Kept(Identity next, Identity step = 1) : next_identity(next), identity_step(step) {}

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
        OpenFrame(Kept& kept, Population<G> population, bool loops = false) : kept_(kept), loops_(loops) {
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
        Kept& kept_;
        Frame<G>* frame_;
        bool loops_, resumed_;
    };

  private:
    static constexpr std::size_t most_notes = 100;

    std::vector<std::string> notes_;
    std::size_t more_notes_ = 0;
};

} // namespace ga
