#pragma once

#include "domain/problem/problem.hpp"
#include "domain/target/out_of_reach.hpp"
#include "ga/run/context.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

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

/// By which pipeline, from where and how long to search.
struct SearchOptions {
    std::string pipeline = {}; ///< text, or one of design_variants; empty: usual_variant
    std::vector<Genome> starts =
        {}; ///< the population to begin with; empty: the pipeline's own, or the Sobol database
    std::uint64_t seed = 1; ///< same seed, same answer, unless `seconds` or `stop` ends the search
    int threads = 0;        ///< 0: as many as OpenMP has
    ga::Evaluator<DesignProblem>* evaluator = nullptr; ///< makes the paid calls; none: threads do
    /// Of wall time, from the call. What verifying the answers takes is kept back, three quarters at most.
    double seconds = std::numeric_limits<double>::infinity();
    long evaluations = std::numeric_limits<long>::max(); ///< curves and gradients
    const std::atomic<bool>* stop = nullptr;             ///< somebody asks the search to end, verifying too
    std::size_t alternatives = 3;                        ///< different answers to return, the best among them
    /// Answers that are verified at the end, of the pipeline's and of the best of its way each; of an area,
    /// where verifying takes longer than searching, two of the pipeline's. Where time is short it is one.
    std::size_t verifying = 3;
    std::optional<Keeping> keeping = {}; ///< nothing: it is kept nowhere
    /// Of curves that searches of one set-up share (DesignProblem).
    std::shared_ptr<ResponseMemory> memory = nullptr;
};

/// A genome in final amplitude and how well it answers. Of an area that was not verified in time the
/// similarities but the first are NaN.
struct Answer {
    Genome genome;                 ///< amplitude final
    double similarity = 0;         ///< on the set-up's grid
    double similarity_refined = 0; ///< on a grid four times finer, Eq. 11 anew where it applies
    double similarity_stepped = 0; ///< in four times the load steps, a measured target's too
    double similarity_worst = 0;   ///< the least of these and of both together
    /// Under the set-up's errors: what 95 % of 200 draws of noise keep, and every tilt; NaN: none given, or
    /// no time.
    double similarity_made = std::numeric_limits<double>::quiet_NaN();
    bool within_limits = true;      ///< it holds every limit of the set-up
    double difference = 1;          ///< from the answers before it, the least
    Verification verification = {}; ///< what these similarities are of

    /// What an answer is verified by: it must survive finer grids and load steps, and errors that were given.
    double lowest() const { return similarity_made < similarity_worst ? similarity_made : similarity_worst; }
    /// Whether all of that is known.
    bool is_verified() const { return !std::isnan(similarity_worst); }
};

/// A genome as an answer, in final amplitude, verified under a set-up as answers are reported (as_reported).
/// Where the set-up's ContactOptions::stop ends that, the similarity on its own grid is found all the same.
/// Throws what respond() throws.
Answer verified_answer(const DesignSetup& reported, const Genome& genome);
/// The answer's own response, as the set-up that was searched asks, solved throughout: of one that was not
/// verified that which it has.
DesignResponse response_of(const DesignSetup& setup, const Answer& answer);

/// A genome that no other found is better than in every target.
struct Compromise {
    Genome genome;                          ///< amplitude final
    std::vector<double> similarity;         ///< each target's, on the set-up's grid
    std::vector<double> similarity_refined; ///< the same on a grid four times finer
};

/// Those of the genomes that are within the limits and that no other is better than, by the first target's
/// similarity, the best last; at most `most`, spread evenly with both ends among them.
std::vector<Compromise> compromises(const DesignSetup& setup, const std::vector<Genome>& genomes,
                                    std::size_t most, int threads);

/// What a search found, and what it took.
struct SearchResult {
    Answer best;                      ///< by its verified similarity
    std::vector<Answer> alternatives; ///< the best first, then the next best that differ from those before
    std::vector<Compromise> front;    ///< what `pareto` found, where the pipeline has it
    /// Of a set-up with errors, verified answers of which none is better both with and without these, by
    /// falling similarity without.
    std::vector<Answer> made;
    ga::Counters counters;          ///< what was spent
    std::vector<std::string> notes; ///< remarks of stages
    std::string stopped;            ///< why the search ended before its pipeline; empty when it did not
    std::string name;               ///< of the variant, or "pipeline": first word of every path
    std::string pipeline;           ///< as it was run
    DesignSetup setup;              ///< what the answers are of, completed
};

/// Throws ga::UsageError where one of design_variants, by its name, or a pipeline as text cannot search a
/// set-up.
void expect_searchable(const DesignSetup& setup, const std::string& way);

/// Runs a pipeline on a design and picks what to believe: of its answers and the best individuals of all its
/// stages those that are best at their worst (Verification). There is always an answer: the best so far, or a
/// first start. Throws ga::UsageError on a pipeline that cannot work or a kept run of another search,
/// InputError on starts for a pipeline that makes its own, NotConverged when no curve of the whole run could
/// be computed.
SearchResult search(const DesignSetup& setup, const SearchOptions& options = {},
                    std::vector<ga::Observer<Genome>> observers = {});

/// Why no profile whatever answers as a set-up asks, and how near one could come.
struct Unreachable {
    std::vector<OutOfReach> reasons; ///< none where the bound leaves room for what is wanted: no verdict then
    double bound = 1;                ///< no profile has a higher similarity
};

/// From here on what is out of reach is not worth telling, where nothing else is asked for.
constexpr double exact_enough = 0.999;

/// Of a set-up solved throughout. `wanted` is the similarity that is enough.
Unreachable unreachable(const DesignSetup& setup, double wanted = exact_enough);

/// Curves and gradients that are enough for the profile nearest to a target out of reach.
constexpr long enough_for_the_nearest = 3000;

} // namespace rough
