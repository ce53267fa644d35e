#pragma once

#include "apps/cluster/cluster.hpp"
#include "apps/experiments/compare/race.hpp"
#include "apps/experiments/experiment.hpp"
#include "domain/numerics/rank_tests.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/setup.hpp"

#include <map>
#include <optional>

/// What a comparison of variants found, and what follows from it.
namespace app {

/// A problem of a comparison.
struct Benchmark {
    std::string name;      ///< e.g. "bbob5-8"
    std::string group;     ///< those that are counted together, e.g. "bbob5"
    std::string kind;      ///< of genome, which decides the variants: real, fronts, bits, tours, surfaces
    std::size_t genes = 1; ///< the D of a budget
    std::vector<double> targets; ///< precisions to be reached, each less than the one before
    /// Throws ga::UsageError on a variant that cannot work here.
    std::function<void(const std::string& variant)> check;
    std::function<Reached(const std::string& variant, int instance, const Attempt&)> run;
};

/// By names of problems or groups: bbobN (BBOB's functions in N dimensions) or bbobN-F, zdt, dtlz, knapsack,
/// tsp or one of theirs, roughness (which needs the set-up of a design). Throws rough::InputError on others.
std::vector<Benchmark> benchmarks(const std::vector<std::string>& names,
                                  const std::optional<rough::DesignSetup>& roughness);

/// Precisions from one to another, evenly on a logarithmic scale; of 51, as COCO has them, every decade of
/// 1e2 to 1e-8 is among them.
std::vector<double> precisions(double from, double to);

/// Pipelines by name.
using Contestants = std::vector<std::pair<std::string, std::string>>;

/// The variants of usual.csv and libpagmo's, by the kind of genome: they run if nothing else is requested.
const std::map<std::string, Contestants>& usual_contestants();

/// All variants on one problem.
struct Bout {
    Benchmark problem;
    Contestants variants;
    long budget = 0;                        ///< evaluations of each run
    std::vector<std::vector<Reached>> runs; ///< a row a variant, in it one a seed
};

struct Contest {
    Origin origin;      ///< its seed is the first, and the number of the first instance
    long seeds = 0;     ///< runs of each variant on each problem
    std::string budget; ///< as it was given
    std::vector<Bout> bouts;
};

/// The number of the instance that a run of this number is on.
inline int instance_of(std::uint64_t number) { return static_cast<int>(1 + (number - 1) % 100000); }

/// Evaluations a success takes in the mean: those of all runs until they reached a target, or ended, over how
/// many reached it (Auger and Hansen 2005); infinite where none did.
double expected_runtime(const std::vector<Reached>& runs, std::size_t target);
long successes(const std::vector<Reached>& runs, std::size_t target);

/// Share of all pairs of run and target that were reached with so many evaluations a gene (COCO's runtime
/// ECDF), and where it lies were other seeds drawn (bootstrap over seeds, 95 %).
struct RuntimeShare {
    std::vector<double> share, lower, upper; ///< at each of a group's `evaluations`
};

/// Two variants against each other.
struct Duel {
    std::string problem; ///< "" over all problems of the group
    std::size_t first, second;
    double difference;   ///< of their mean areas
    double p, corrected; ///< two-sided, and after Holm's correction over the pairs
};

/// The problems of a group together.
struct GroupResult {
    std::string name;
    std::vector<const Bout*> bouts;
    std::vector<double> evaluations;  ///< a gene, evenly on a logarithmic scale
    std::vector<RuntimeShare> shares; ///< a variant each
    /// [problem][variant][seed]: mean height of a run's share of targets over `evaluations`; 1 would be all
    /// targets at once, 0 none ever. This is what is ranked and tested.
    std::vector<std::vector<std::vector<double>>> areas;
    rough::Friedman ranks; ///< of mean areas over the problems, the best first; of one problem over its seeds
    std::vector<Duel> duels; ///< signed ranks over the problems, then rank sums over each problem's seeds
};

std::vector<GroupResult> analysed(const Contest& contest);

/// Mean area of a variant over a group's problems.
double mean_area(const GroupResult& group, std::size_t variant);

/// The runs on BBOB's functions as COCO has them (ga::write_coco): a folder for each variant.
void write_coco_runs(const Contest& contest, const std::filesystem::path& folder);

/// result.json, runs.csv, ert.csv, ecdf.csv and tests.csv.
Findings findings_of(const Contest& contest, const std::vector<GroupResult>& groups);

/// What each rank does for a comparison: from a race to what it reached. `setting` has the names of the
/// problems, and the set-up of roughness or null.
cluster::Work races_under(const nlohmann::json& setting);

} // namespace app
