#pragma once

#include "apps/prompt/settings.hpp"
#include "apps/report/record.hpp"
#include "domain/accuracy/resolution.hpp"
#include "domain/design/morph.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/target/out_of_reach.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// What a design was asked for and what it found, as the program and Python read it, and its files.
namespace app {

struct Fact {
    std::string key;  ///< in result.json
    std::string name; ///< as for reading
    std::string text;
};

/// Names of quantities, and the share by which each is off at most.
using Shares = std::vector<std::pair<std::string, double>>;

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
    std::optional<Shares> not_asked;
    std::vector<StageRecord> stages;
    std::vector<rough::Margin> margins;
    std::optional<rough::Tolerance> tolerance; ///< none if the run was interrupted
    std::optional<rough::Trust> trust;         ///< none where there was no time for it

    Summary summary;
    bool interrupted = false;
    double seconds = 0;
    Origin origin;
};

/// The parameters of a search that the program and Python share: what is looked for beside the target, how,
/// how long, under which model.
std::vector<Setting> search_settings();
/// With those of the program alone: target or scan, production, files.
std::vector<Setting> design_settings();

/// What the settings ask for, with the exact tests of what is out of reach done. Throws rough::InputError.
DesignRun design_from(const Settings& settings);
/// The same for targets and a model from elsewhere, which `take_targets` fills in.
DesignRun design_from(const Settings& settings,
                      const std::function<void(const Settings&, DesignRun&)>& take_targets);

/// Sets a set-up's targets and model to what a measured surface's own response, under its model `own`, asks
/// for; with a resolution as a band.
void like_surface(const rough::Profile& surface, const rough::Model& own, const std::string& name,
                  const Settings& settings, rough::DesignSetup& setup,
                  rough::Resolution resolution = rough::Resolution::off);

/// Whether what was asked for was found and verified, within the limits, and no target is out of reach.
bool is_found(const DesignRun& run);
/// Of a run whose answer was found, and verified where there was time.
Summary summary_of(const DesignRun& run);
/// Quantities that were not asked for, how far the answer is off from the scan's at most.
Shares off_unasked(const DesignRun& run);
/// `summary` of result.json.
nlohmann::json summary_json(const DesignRun& run);

/// Writes result.json, and tolerance.csv if the tolerance is known.
void write_design_result(const DesignRun& run, const std::filesystem::path& folder);
/// Writes answer.csv, the answer's own curve, and genome.json.
void write_design_tables(const DesignRun& run, const std::filesystem::path& folder);
/// Writes the tables that the page's figures draw: curves.csv, points.csv, heights-drawn.csv or map.csv, and
/// front.csv or made.csv.
void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder);

} // namespace app
