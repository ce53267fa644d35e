#pragma once

#include "apps/report/record.hpp"
#include "domain/problem/problem.hpp"

#include <string>
#include <vector>

/// What the comparison of ways to search found, as its page and files read it.
namespace app {

/// The best so far when so much was spent.
struct Spent {
    long asked;     ///< curves and gradients
    double seconds; ///< since the search began
    double similarity;
};

struct RaceRun {
    std::uint64_t seed;
    std::vector<Spent> history; ///< after each stage
    VariantRun run;
    double last_displacement = 0; ///< of the answer, at the end of the load, mm
    long crossed = 0, better = 0; ///< children of two scored parents, and those above the better parent
};

struct RaceVariant {
    std::string name, pipeline;
    std::vector<RaceRun> runs; ///< one a seed
    double median_lowest() const;
    const RaceRun& median_run() const; ///< whose verified similarity is the median, or the next below
    /// Median over the runs of the best similarity when so much was asked for.
    double median_at(long asked) const;
    double median_at_seconds(double seconds) const;
};

struct RaceTarget {
    rough::DesignSetup setup;
    std::vector<RaceVariant> variants;
};

struct Race {
    std::vector<RaceTarget> targets;
    Origin origin; ///< its seed is the first
    long budget = 0;
};

} // namespace app
