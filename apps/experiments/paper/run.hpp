#pragma once

#include "apps/experiments/experiment.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/paper/dominance.hpp"
#include "domain/paper/variants.hpp"

#include <limits>

/// Results of the paper's experiment. Pressures in MPa, lengths in mm, stiffness in MPa/mm. An unknown number
/// is NaN.
namespace app {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The paper's algorithms, as variants are named.
inline constexpr std::array<const char*, 3> algorithms{"sog", "gco", "cco"};

/// Similarity of one genome with a target (Eq. 12).
struct Scores {
    double all;  ///< on all points
    double low;  ///< on [0, p_bar]
    double high; ///< on [p_bar, p_max]
};

/// One cross-over algorithm at one threshold p_bar.
struct ThresholdRow {
    double p_bar = 0;
    std::string variant;                ///< gco or cco
    std::size_t u1 = 0, u2 = 0;         ///< sizes of U1 and U2 when pairs are formed
    bool at_least_used = false;         ///< U1 or U2 had fewer than "at least" genomes above 0.95
    std::size_t children = 0;           ///< |U4|: the distinct children; |U3| = u1 u2 counts twins
    double share_above = 0;             ///< share of the distinct children with s > 0.95, 0..1
    double best_child = 0;              ///< best similarity among them, before any GCMMA
    std::vector<std::uint64_t> parents; ///< the answer's parents
    double similarity = 0;              ///< the answer's, after the last GCMMA
};

/// Everything that depends on one target.
struct TargetRun {
    std::string title; ///< "drawn" or "held-out"
    rough::Target target;
    double p_bar = 0;                           ///< threshold of the variants below
    std::vector<Scores> database = {};          ///< one per database genome, in the same order
    std::vector<VariantRun> variants = {};      ///< the paper's three, then their minimax forms
    std::vector<ThresholdRow> thresholds = {};  ///< p_bar ascending, gco and cco at each
    std::vector<VariantRun> other_reading = {}; ///< the paper's three under the other reading of Algorithm 1
};

struct PaperRun {
    Origin origin;
    double seconds = 0;      ///< wall time of the run without the page
    rough::Model model;      ///< solved exactly, for all reported numbers
    rough::Model searched;   ///< with the accuracy of the searches
    double max_pressure = 0; ///< p_max
    rough::DominanceReading dominance = rough::DominanceReading::same_pressure; ///< reading of Algorithm 1
    double dominant_above = rough::dominance_threshold;                         ///< its correlation
    bool reduces_children = false; ///< CCO reduces the children instead of the parents
    rough::PhaseReach reach;       ///< how far refinement moves a phase
    rough::DatabaseLayout layout;
    std::uint64_t phases = 0;       ///< 0: Sobol's; else the number of a set drawn from the seed
    std::vector<Answered> database; ///< pair by pair, each with every phase column
    std::vector<TargetRun> targets; ///< drawn, then held-out
    std::map<std::string, std::string> other_readings; ///< claims under other readings, in words, by id
};

/// The keys that experiments/paper.ini may set.
std::vector<Setting> paper_settings();

/// The requested models, targets, database and seed; nothing is run. Reads targets and scans. Relative paths
/// in the .ini file are relative to its folder. Throws rough::InputError.
PaperRun paper_from(const Settings& settings, const Origin& origin);

struct Studies;
/// result.json and tables, those of a second target in the folder heldout.
Findings findings_of(const PaperRun& run, const Studies& studies);

/// A database's genomes with their responses, rescaled to a pressure by Eq. 11.
std::vector<Answered> answered(const std::vector<rough::Genome>& genomes, const rough::Model& model,
                               double max_pressure, int threads);

} // namespace app
