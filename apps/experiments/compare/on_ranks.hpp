#pragma once

#include "apps/cluster/cluster.hpp"
#include "apps/experiments/compare/benchmarks.hpp"

namespace app {

/// The number of the instance that a run of this number is on.
inline int instance_of(std::uint64_t number) { return static_cast<int>(1 + (number - 1) % 100000); }

/// One run of a comparison.
struct CompareRun {
    std::string problem, pipeline;
    int instance = 1;
    std::uint64_t seed = 1;
    long budget = 0;
};

/// Runs it here; ends early where the program is asked to stop.
Reached raced(const Benchmark& problem, const CompareRun& run);

/// So many races on all ranks, each as `run_of` its place says; `take` gets what they reached, in any order.
void race_on_ranks(const std::optional<rough::DesignSetup>& roughness, int threads, std::size_t count,
                   const std::function<CompareRun(std::size_t)>& run_of,
                   const std::function<void(std::size_t, Reached)>& take);
/// What each rank does for it: from a race to what it reached.
cluster::Work races_under(const nlohmann::json& setting);

} // namespace app
