#pragma once

#include "domain/design/options.hpp"
#include "domain/problem/problem.hpp"
#include "domain/target/out_of_reach.hpp"

namespace rough {

using SearchOptions = SearchOptionsOf<DesignProblem>; ///< options of a search for genomes

/// A genome that a search returns, and its similarities. If time ran out during the verification of a map,
/// the similarities without a result and `worst` are NaN; `similarity` is always known.
struct Answer : Verification {
    Genome genome = {}; ///< if Eq. 11 is used, its amplitude contains the factor of Eq. 11
    /// The lower of two similarities under DesignSetup::errors. The first is the similarity that 95 % of 200
    /// draws of noise reach. The second is the lowest similarity over the tilts. NaN without errors, for a
    /// map, for an unverified answer and from verified_answer().
    double similarity_made = std::numeric_limits<double>::quiet_NaN();
    bool within_limits = true; ///< whether the genome keeps every limit of the set-up
    double difference = 1;     ///< smallest difference() from the answers before it in a list

    /// The similarity that counts: `worst`, or the similarity under the given errors if that is lower.
    double lowest() const { return similarity_made < worst ? similarity_made : worst; }
    bool is_verified() const { return !std::isnan(worst); } ///< whether `worst` is known
};

/// Verifies one genome. `reported` is the set-up that as_reported() returns. If ContactOptions::stop ends the
/// verification, the similarity on the set-up's grid and load steps is still computed. The other similarities
/// may then be NaN. Throws what respond() throws.
Answer verified_answer(const DesignSetup& reported, const Genome& genome);
/// The set-up in which errors of making are tried. The targets are corrected so that the answer has the misfits of its
/// verdict (Verification::largest) there. The cells of a map are joined by 2 x 2 as often as three conditions hold. All
/// misfits of the answer change by at most 0.01 before the correction. Its shortest wave has four cells. The
/// correlation length of the noise has one. The result is the set-up itself if the answer is not verified.
DesignSetup as_verified(const DesignSetup& setup, const Answer& answer);
/// The answer's response under the set-up; if the verification is incomplete, the stored one.
DesignResponse response_of(const DesignSetup& setup, const Answer& answer);

/// A genome on the Pareto front of the targets' similarities.
struct Compromise {
    Genome genome;                          ///< if Eq. 11 is used, its amplitude contains the factor of Eq. 11
    std::vector<double> similarity;         ///< similarity to each target, on the set-up's grid
    std::vector<double> similarity_refined; ///< similarity to each target, on a grid four times finer
};

/// The genomes on the Pareto front of their similarities to the targets, in the order of rising similarity to
/// the first target. Genomes beyond the set-up's limits are left out. If the front has more than `max_count`
/// genomes, both ends and evenly spread genomes between them are returned.
std::vector<Compromise> compromises(const DesignSetup& setup, const std::vector<Genome>& genomes, std::size_t max_count,
                                    int threads);

/// The result of a search and its cost.
struct SearchResult : SearchRun {
    Answer best; ///< the answer with the highest rank, see search()
    /// The best answer, then further answers that differ from all answers before them, the best first.
    std::vector<Answer> alternatives;
    std::vector<Compromise> front; ///< front of the stage `pareto`; empty if the pipeline does not have it
    /// Answers on the Pareto front of two similarities: without DesignSetup::errors, and with these errors.
    /// The similarity without errors falls from answer to answer. Empty for a map and without errors.
    std::vector<Answer> made;
};

/// Throws ga::UsageError if the pipeline (a text or one of design_variants) cannot search the set-up.
void expect_searchable(const DesignSetup& setup, const std::string& pipeline);

/// Runs a pipeline on a design. Verifies the genomes that SearchOptions::verifying describes, and the
/// alternatives. Answers within the limits rank above answers beyond them. In each of these two groups,
/// verified answers rank first, by lowest(). Unverified answers follow, by similarity.
///
/// If the search is stopped before its first curve, the answer is a start genome. If all its curves are on
/// coarser grids, the answer is the best genome of the last population that was scored on a coarser grid.
///
/// Throws ga::UsageError on a pipeline that cannot work or a checkpoint of another search. Throws InputError
/// if starts are given to a pipeline that makes starts. Throws NotConverged if every evaluation failed.
SearchResult search(const DesignSetup& setup, const SearchOptions& options = {},
                    std::vector<ga::Observer<Genome>> observers = {});

/// Why no surface can meet a set-up's targets, and an upper bound on the similarity of any surface.
struct Unreachable {
    std::vector<OutOfReach> reasons; ///< empty if the bound is at least the required similarity
    double bound = 1;                ///< upper bound on the similarity of any surface
};

constexpr double exact_enough = 0.999; ///< usual similarity for unreachable()

/// The reasons and the lowest of their bounds; no reasons if a surface may have the similarity `required`.
Unreachable unreachable(std::vector<OutOfReach> reasons, double required);
/// The reasons and the bound for a set-up.
Unreachable unreachable(const DesignSetup& setup, double required);

/// Remarks on settings that leave little to search, each in one line. The price is at most eight curves,
/// which ContactOptions::stop ends.
/// - waves below four node spacings are allowed, which the grid does not show
/// - under Eq. 11, of four starts none has less than `nearly_full` contact at the last load step
/// - under Eq. 11, heights within the limits are too low for the approach that the first target needs
std::vector<std::string> doubts(const DesignSetup& setup);

constexpr long enough_for_the_nearest = 3000; ///< maximum number of evaluations if the target is out of reach

} // namespace rough
