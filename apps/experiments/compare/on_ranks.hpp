#pragma once

#include "apps/experiments/compare/benchmarks.hpp"

namespace app {

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

} // namespace app
