#pragma once

#include "domain/design/options.hpp"
#include "domain/problem/problem.hpp"
#include "domain/target/out_of_reach.hpp"

namespace rough {

using SearchOptions = SearchOptionsOf<DesignProblem>;         ///< options of a search for waves
using CheckpointOptions = CheckpointOptionsOf<DesignProblem>; ///< checkpoints of a search for waves

/// A genome at its final amplitude, and its similarities. If time ran out during the verification of a map,
/// the similarities without a result and similarity_worst are NaN.
struct Answer {
    Genome genome;                 ///< amplitude final
    double similarity = 0;         ///< on the set-up's grid
    double similarity_refined = 0; ///< on a grid four times finer, with Eq. 11 applied again
    /// With four times the load steps. A target that is computed from a measured profile is computed again in
    /// these steps, too.
    double similarity_stepped = 0;
    double similarity_worst = 0; ///< lowest of these three and of that on the finer grid with finer steps
    /// The lower of two similarities under the set-up's errors: the one that 95 % of 200 noise draws reach,
    /// and the lowest over tilts. NaN without errors, for a map, for an unverified answer and from
    /// verified_answer().
    double similarity_made = std::numeric_limits<double>::quiet_NaN();
    bool within_limits = true;      ///< whether it keeps every limit of the set-up
    double difference = 1;          ///< smallest difference from the answers before it
    Verification verification = {}; ///< the curves that these similarities belong to

    /// The similarity that counts: on finer grids, with finer load steps and under the given errors.
    double lowest() const { return similarity_made < similarity_worst ? similarity_made : similarity_worst; }
    /// Whether similarity_worst is known.
    bool is_verified() const { return !std::isnan(similarity_worst); }
};

/// Verifies a genome under a set-up from as_reported(). If the set-up's ContactOptions::stop ends this, the
/// similarity on the set-up's grid and load steps is still computed; the other similarities may be NaN.
/// Throws what respond() throws.
Answer verified_answer(const DesignSetup& reported, const Genome& genome);
/// The answer's response under the set-up; pass exactly(setup) for a response without approximations. If the
/// verification is incomplete, the response that the answer stores is returned.
DesignResponse response_of(const DesignSetup& setup, const Answer& answer);

/// A genome on the Pareto front of the targets' similarities.
struct Compromise {
    Genome genome;                          ///< amplitude final
    std::vector<double> similarity;         ///< for each target, on the set-up's grid
    std::vector<double> similarity_refined; ///< for each target, on a grid four times finer
};

/// The Pareto front of the genomes that keep the limits, by rising similarity to the first target. If it has
/// more than `max_count` genomes, both ends and evenly spread ones between them are returned.
std::vector<Compromise> compromises(const DesignSetup& setup, const std::vector<Genome>& genomes,
                                    std::size_t max_count, int threads);

/// The result of a search and its cost.
struct SearchResult {
    Answer best;                      ///< the answer with the highest rank, see search()
    std::vector<Answer> alternatives; ///< the best, then the next best ones that differ from all before them
    std::vector<Compromise> front;    ///< from `pareto`; empty if the pipeline does not have it
    /// For a profile whose set-up has errors: the answers on the Pareto front of the similarities without and
    /// with errors. They are sorted by falling similarity without errors.
    std::vector<Answer> made;
    ga::Counters counters;          ///< evaluations spent
    std::vector<std::string> notes; ///< remarks of stages
    std::string stopped;            ///< why a stop or a budget ended the pipeline early; empty if neither did
    std::string name;               ///< the variant's name or "pipeline": first word of every path
    std::string pipeline;           ///< text that was run
    DesignSetup setup;              ///< with its defaults filled in
};

/// Throws ga::UsageError if the pipeline (a text or one of design_variants) cannot search the set-up.
void expect_searchable(const DesignSetup& setup, const std::string& pipeline);

/// Runs a pipeline on a design and verifies the genomes that SearchOptions::verifying describes, and the
/// alternatives. The best answer has the highest rank: answers within the limits first, then verified ones,
/// by lowest(). If the search is stopped before its first curve, the answer is a start genome. If it has
/// curves only on coarser grids, the answer is the best genome of the last population that was scored there.
///
/// Throws ga::UsageError on a pipeline that cannot work or a checkpoint of another search. Throws InputError
/// if starts are given to a pipeline that makes starts. Throws NotConverged if every evaluation failed.
SearchResult search(const DesignSetup& setup, const SearchOptions& options = {},
                    std::vector<ga::Observer<Genome>> observers = {});

/// Why no profile can meet a set-up's targets, and an upper bound on the similarity of any profile.
struct Unreachable {
    std::vector<OutOfReach> reasons; ///< empty if the bound is at least the required similarity
    double bound = 1;                ///< no profile has a higher similarity
};

/// A target is reported as out of reach if no profile can have this similarity. A caller may require another
/// value.
constexpr double exact_enough = 0.999;

/// The verdict on a set-up, without approximations; `required` is the similarity that the caller requires.
Unreachable unreachable(const DesignSetup& setup, double required = exact_enough);

/// Limit on evaluations if the target is out of reach.
constexpr long enough_for_the_nearest = 3000;

} // namespace rough
