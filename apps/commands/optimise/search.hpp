#pragma once

#include "apps/commands/optimise/children.hpp"
#include "apps/external/genes.hpp"

#include <atomic>
#include <filesystem>
#include <functional>

namespace app {

/// What is asked of a search whose genomes are evaluated outside, and, below, what came of it beside the
/// children's record.
struct OutsideSearch {
    Genes genes;
    std::string variant, pipeline; ///< one of them, or none for ga or, of several objectives, nsga2
    std::string minimise;          ///< as for `minimised`
    std::uint64_t seed = 1;
    long evaluations = 0;                         ///< at most
    double seconds = 0;                           ///< at most, from the call on
    const std::atomic<bool>* stop = nullptr;      ///< see ga::Budget
    std::filesystem::path checkpoint;             ///< file
    bool resume = false;                          ///< go on from it
    std::string description;                      ///< of what decides the result beside the pipeline and seed
    std::function<void(const std::string&)> show; ///< progress

    std::string searched;           ///< the pipeline as it was run
    long spent = 0;                 ///< evaluations
    std::string stopped;            ///< why it ended before its pipeline; empty when it did not
    std::vector<std::string> notes; ///< the engine's remarks
};

/// Searches. Throws ga::UsageError on a pipeline that cannot work; trouble with a child is the children's to
/// tell.
void search(OutsideSearch& search, Children& children);

} // namespace app
