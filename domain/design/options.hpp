#pragma once

#include "ga/run/context.hpp"

#include <filesystem>

namespace ga {
template <Problem P>
class Checkpoints;
}

namespace rough {

struct ResponseMemory;

/// Options for the checkpoints of a search, from which it can be resumed.
template <ga::Problem P>
struct CheckpointOptionsOf {
    std::filesystem::path file; ///< path of the file; each checkpoint replaces the whole file by renaming
    bool resume = false;        ///< whether to continue from the file if it exists
    std::function<void(ga::Checkpoints<P>&)> add_values = {}; ///< adds values of observers to the checkpoints
    double interval = 1;                                      ///< minimum time between two checkpoints, s
    std::string inputs = {};                                  ///< fingerprints of the files that the run reads
};

/// Pipeline, starts and budget of a search for designs with any type of genome.
template <ga::Problem P>
struct SearchOptionsOf {
    std::string pipeline = {}; ///< text of a pipeline, or the name of a variant; empty: the usual variant
    std::vector<typename P::Genome> starts = {}; ///< first population; empty: from the pipeline or a database
    std::uint64_t seed = 1; ///< equal seeds give equal answers unless `seconds` or `stop` ends the search
    int threads = 0;        ///< number of threads; 0: as many as OpenMP has
    ga::Evaluator<P>* evaluator = nullptr; ///< makes the evaluations; null: threads make them
    /// Wall time from the call on, s. At most three quarters of it are reserved for verifying the answers.
    double seconds = std::numeric_limits<double>::infinity();
    long evaluations = std::numeric_limits<long>::max(); ///< maximum number of curves and gradients
    const std::atomic<bool>* stop = nullptr;             ///< true ends the search and its verification
    std::size_t alternatives = 3;                        ///< number of different answers, including the best
    /// Maximum number of genomes from each source that are verified at the end; 1 if time is short. The sources are the
    /// final population and the answers that the pipeline verified. For a profile they are also the best individuals of
    /// all stages and the first given start. For a map at most two genomes of each source are verified. If no source
    /// has a genome, the best of all stages is verified. (Only for DesignProblem.)
    std::size_t verifying = 3;
    std::optional<CheckpointOptionsOf<P>> checkpoints = {}; ///< none: no checkpoints are written
    /// Curves that several searches of one set-up share (only for DesignProblem).
    std::shared_ptr<ResponseMemory> memory = nullptr;
};

/// The pipeline that a search ran, its cost and its remarks.
struct SearchRun {
    std::string name = {};               ///< name of the variant, or "pipeline"; the paths of all stages begin with it
    std::string pipeline = {};           ///< text of the pipeline
    ga::Counters counters = {};          ///< evaluations spent by the pipeline
    std::vector<std::string> notes = {}; ///< remarks of stages
    std::string stopped = {};            ///< why a stop or a budget ended the pipeline early; empty if neither did
};

/// A function for ContactOptions::stop: true from `seconds` after this call on, and when `stop` is true.
inline std::function<bool()> ending_after(double seconds, const std::atomic<bool>* stop) {
    return [watch = ga::Watch({std::numeric_limits<long>::max(), seconds, stop})] { return watch.expired(); };
}

} // namespace rough
