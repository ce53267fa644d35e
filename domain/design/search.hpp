#pragma once

#include "domain/design/front.hpp"
#include "domain/profile/difference.hpp"
#include "ga/context.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>

namespace ga {
template <Problem P>
class Checkpoints;
}

namespace rough {

/// Where a search is kept on its way, so that it can go on after its process has ended.
struct Keeping {
    std::filesystem::path file; ///< replaced as a whole, by renaming
    bool resume = false;        ///< go on from the file, where there is one
    /// Hands the keeper what observers hold, to be kept with the run.
    std::function<void(ga::Checkpoints<DesignProblem>&)> also = {};
    double interval = 1; ///< seconds between two writes, at least
};

/// How long, from where and by which pipeline to search.
struct SearchOptions {
    std::string variant = "default"; ///< first word of every path
    std::string pipeline = {};       ///< text; empty: the named variant's
    std::vector<Genome> starts =
        {}; ///< the population to begin with; empty: the pipeline's own, or the Sobol database
    std::uint64_t seed = 1; ///< same seed, same answer, unless `seconds` or `stop` ends the search
    int threads = 0;        ///< 0: as many as OpenMP has
    ga::Evaluator<DesignProblem>* evaluator = nullptr; ///< makes the paid calls; none: threads do
    /// Of wall time, from the call. On an area, where judging takes longer than searching, that is within it:
    /// the search keeps time back for it, as long as a quarter is left for the search.
    double seconds = std::numeric_limits<double>::infinity();
    long evaluations = std::numeric_limits<long>::max(); ///< curves and gradients
    const std::atomic<bool>* stop = nullptr;             ///< somebody asks the search to end, judging too
    /// Ends when an answer's worst similarity (Judgement) is this; a pipeline that makes its own starts is
    /// begun up to eight times for it.
    std::optional<double> reach = {};
    /// Searches in the set-up's load steps, then aims again at the targets less what finer steps and grids
    /// change (aimed_again). Where 4 times the steps, or 16 times, still lower the answer's similarity by
    /// more than 0.005, that is done in 4 times as many (in_finer_steps, twice at most). `default`,
    /// `in-line`, `multistart` only; their own last stages, which refine what is judged, are left out.
    bool settles_steps = false;
    /// Begins anew from other starts while the seconds or evaluations given are not spent and nothing is
    /// worth the name: `default` and `multistart`. `like` goes on from what it has.
    bool begins_anew = false;
    std::size_t alternatives = 3; ///< different answers to return, the best among them
    /// Answers of the pipeline, and best ones of its way, compared on the finer grid at the end. On an area,
    /// whose finer grid costs much, only the best so far is judged.
    std::size_t compared = 3;
    std::optional<Keeping> keeping = {}; ///< nothing: it is kept nowhere
    /// Of curves that searches of one set-up share (DesignProblem).
    std::shared_ptr<ResponseMemory> memory = nullptr;
};

/// A genome in final amplitude and how well it answers. Of an area that was not judged in time the
/// similarities but the first are NaN.
struct Answer {
    Genome genome;                 ///< amplitude final
    double similarity = 0;         ///< on the set-up's grid
    double similarity_refined = 0; ///< on a grid four times finer, Eq. 11 anew where it applies
    double similarity_stepped = 0; ///< in four times the load steps, a measured target's too
    double similarity_worst = 0;   ///< the least of these and of both together
    bool within_limits = true;     ///< it holds every limit of the set-up
    double difference = 1;         ///< from the answers before it, the least
    Judgement judgement = {};      ///< what these similarities are of

    /// What an answer is judged by: it must survive finer grids and load steps.
    double judged() const { return similarity_worst; }
    /// Whether all of that is known.
    bool is_judged() const { return !std::isnan(similarity_worst); }
};

/// A genome as an answer, in final amplitude, judged under a set-up as answers are reported (as_reported).
/// Throws what respond() throws.
Answer judged_answer(const DesignSetup& reported, const Genome& genome);
/// The same by a judge of that set-up. Where that is stopped the similarity on the set-up's own grid is found
/// all the same.
Answer judged_answer(const Judge& judge, const Genome& genome);
/// The answer's own response, as the set-up that was searched asks, solved throughout: of one that was not
/// judged that which it has.
DesignResponse response_of(const DesignSetup& setup, const Answer& answer);

/// The similarity from which on an answer is called found, where none is asked for.
constexpr double worth_the_name = 0.99;

/// What a search found, and what it took.
struct SearchResult {
    Answer best;                      ///< by its judged similarity
    std::vector<Answer> alternatives; ///< the best first, then the next best that differ from those before
    std::vector<Compromise> front;    ///< what `pareto` found, where the pipeline has it
    ga::Counters counters;            ///< what was spent
    std::vector<std::string> notes;   ///< remarks of stages
    std::string stopped;              ///< why the search ended before its pipeline; empty when it did not
    std::string pipeline;             ///< as it was run, each on a line where the search went on
    DesignSetup setup;                ///< what the answers are of: the one given, or in finer load steps
};

/// The ways to search that have a name, as text: `default`, `like`, `in-line`, `multistart`, `plain`, `sog`,
/// `gco`, `cco`, `mcco` and `nsga2` (two targets), `atlas`, `esch`, `crs2`. Those that do not begin with
/// `shape`, `own` or `sample` work on the Sobol database.
const std::map<std::string, std::string>& design_variants();

/// Throws ga::UsageError where one of design_variants, by its name, or a pipeline as text cannot search a
/// set-up.
void expect_searchable(const DesignSetup& setup, const std::string& way);

/// Whether the genome (in final amplitude) is within every limit.
bool holds_limits(const DesignSetup& setup, const Genome& genome);

/// Runs a pipeline on a design and picks what to believe: of the best individuals of all stages those that
/// are best at their worst (Judgement). There is always an answer: the best so far, or a first start. On an
/// area `default` searches coarser grids first and goes on from what they found; where the judged answer
/// falls short of `reach`, or of worth_the_name, by the grids' and steps' errors, it aims again with these
/// allowed for, twice at most. Throws ga::UsageError on a pipeline that cannot work or a kept run of another
/// search, NotConverged when no curve of the whole run could be computed.
SearchResult search(const DesignSetup& setup, const SearchOptions& options = {},
                    std::vector<ga::Observer<Genome>> observers = {});

} // namespace rough
