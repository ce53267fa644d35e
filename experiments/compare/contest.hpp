#pragma once

#include "apps/experiments/experiment.hpp"
#include "domain/problem/setup.hpp"
#include "experiments/compare/race.hpp"

/// Runs of a comparison of variants, and their statistics.
namespace app {

/// A problem of a comparison.
struct Benchmark {
    std::string name;            ///< e.g. "bbob5-8"
    std::string group;           ///< problems with common statistics, e.g. "bbob5"
    std::string kind;            ///< kind of genome and so of variants: real, fronts, bits, tours, surfaces
    std::size_t genes = 1;       ///< D of a budget
    std::vector<double> targets; ///< falling precisions to reach
    /// Throws ga::UsageError on a variant that cannot work here.
    std::function<void(const std::string& variant)> check;
    std::function<Reached(const std::string& variant, int instance, const Attempt&)> run;
    std::optional<rough::DesignSetup> setup = {}; ///< null unless it is a roughness problem
};

/// Problems by the names of problems or groups. Names are bbobN (BBOB's functions in N dimensions), bbobN-F, zdt, dtlz,
/// knapsack, tsp, their problems, and roughness: one problem for each of the given setups. If there are several, the
/// names of their targets follow, as in roughness-drawn. Throws rough::InputError on other names.
std::vector<Benchmark> benchmarks(const std::vector<std::string>& names,
                                  const std::vector<rough::DesignSetup>& roughness);

/// The 51 precisions of COCO, evenly on a logarithmic scale. From 1e2 to 1e-8 they include every decade.
std::vector<double> precisions(double from, double to);

/// Pipelines by name.
using Contestants = std::vector<std::pair<std::string, std::string>>;

/// The variants of usual.csv and libpagmo's, by the kind of genome: they run if nothing else is requested.
const std::map<std::string, Contestants>& usual_contestants();

/// All variants on one problem.
struct ProblemResults {
    Benchmark problem;
    Contestants variants;
    long budget = 0;                        ///< evaluations of each run
    std::vector<std::vector<Reached>> runs; ///< [variant][seed]
};

struct Contest {
    Origin origin;      ///< its seed is the first seed and the number of the first instance
    long seeds = 0;     ///< runs of each variant on each problem
    std::string budget; ///< as given
    long curves = 0;    ///< budget of a run on roughness
    std::vector<ProblemResults> results;
};

/// Number of the instance for a seed.
inline int instance_of(std::uint64_t number) { return static_cast<int>(1 + (number - 1) % 100000); }

/// Mean number of evaluations per success (Auger and Hansen 2005). It is the sum of the evaluations of all
/// runs, until they reach the target or end, over the number of successes. Infinite without a success.
double expected_runtime(const std::vector<Reached>& runs, std::size_t target);
long successes(const std::vector<Reached>& runs, std::size_t target);

/// Writes the runs on BBOB's functions in COCO's format (ga::write_coco), one folder per variant.
void write_coco_runs(const Contest& contest, const std::filesystem::path& folder);

/// result.json, runs.csv, ert.csv, ecdf.csv and tests.csv. In these the area of a run is its mean share of
/// reached targets, over the evaluations on a logarithmic scale. At 1 all targets are reached at once, at 0
/// none ever. Ranks and tests compare areas. For roughness also answers.csv, progress.csv and surfaces.csv.
Findings findings_of(const Contest& contest);

} // namespace app
