#pragma once

#include "apps/report/record.hpp"
#include "domain/design/morph.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/target/out_of_reach.hpp"

#include <optional>
#include <string>
#include <vector>

/// What `rugosa design` was asked for and what it found, as its result file and page read it.
namespace app {

struct Fact {
    std::string key;  ///< in result.json
    std::string name; ///< as for reading
    std::string text;
};

/// A surface in production that is to be brought back to its target.
struct Production {
    std::string file; ///< of its genome
    rough::Genome genome;
    std::vector<rough::ChromosomeName> control;
    double largest_change = 0; ///< of a phase, over a turn
};

/// What a design comes to, at a glance: the report's first screen, `summary` of result.json and the last
/// lines on the terminal are this.
struct Summary {
    bool found = false;
    /// The answer's lowest similarity, under noise, tilt and hardness if given; NaN: not verified.
    double verified = 0;
    std::string verdict; ///< in one line
    std::vector<Fact> facts;
};

struct DesignRun {
    rough::DesignSetup setup;    ///< solved throughout: all that is said of the answer
    rough::DesignSetup searched; ///< the same with the accuracy that the search was allowed
    rough::SearchOptions options;
    rough::TrustOptions trust_options;
    rough::ToleranceOptions tolerance_options;
    std::vector<std::string> accounts; ///< of scans read
    bool limits_given = false;         ///< of making, by a flag
    std::optional<Production> from;    ///< it is morphed, nothing is searched

    std::vector<rough::OutOfReach> out_of_reach;
    double bound = 1; ///< no profile is more similar than this, by exact tests

    rough::SearchResult found;
    std::optional<rough::Morphed> morphed;
    rough::DesignResponse own; ///< the answer's own
    /// Quantities that were not asked for, how far the answer is off from the scan's at most; none where
    /// there was no time for it.
    std::optional<std::vector<std::pair<std::string, double>>> not_asked;
    std::vector<StageRecord> stages;
    std::vector<rough::Margin> margins;
    std::optional<rough::Tolerance> tolerance; ///< none if the run was interrupted
    std::optional<rough::Trust> trust;         ///< none where there was no time for it

    Summary summary;
    bool interrupted = false;
    double seconds = 0;
    Origin origin;
};

} // namespace app
