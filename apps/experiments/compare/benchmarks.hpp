#pragma once

#include "apps/experiments/compare/race.hpp"
#include "domain/problem/setup.hpp"

#include <map>
#include <optional>

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

/// Who runs where nothing else is asked for, by the kind of genome.
const std::map<std::string, Contestants>& usual_contestants();

} // namespace app
