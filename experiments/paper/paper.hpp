#pragma once

#include "apps/experiments/experiment.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/paper/variants.hpp"

/// The paper's experiment: its results, measurements that do not depend on a search, and claims. Pressures in
/// MPa, lengths in mm, stiffness in MPa/mm. An unknown number is NaN.
namespace app {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Similarity of one genome with a target (Eq. 12).
struct Scores {
    double all;  ///< on all points
    double low;  ///< on [0, p_bar]
    double high; ///< on [p_bar, p_max]
};

/// Everything that depends on one target.
struct TargetRun {
    std::string title; ///< "drawn" or "held-out"
    rough::Target target;
    std::vector<Scores> database = {};     ///< one per database genome, in the same order
    std::vector<VariantRun> variants = {}; ///< the paper's three, then their minimax forms
    /// Rows of thresholds.csv with U3 and the answer's `parents`: p_bar ascending, gco and cco at each. U1
    /// and U2 are the sizes of the sets of parents when pairs are formed. `at_least_used`: one of them had
    /// fewer than "at least" genomes above 0.95. `children` is |U4|, the number of distinct children; U3 = U1
    /// U2 counts twins. `share_above` is the share of the distinct children above 0.95, and `best_child` the
    /// best similarity among them before any GCMMA. `similarity` is the answer's after the last GCMMA.
    std::vector<nlohmann::json> thresholds = {};
};

struct PaperRun {
    Origin origin;
    double seconds = 0; ///< wall time of the run without the page
    rough::Model model;
    double max_pressure = 0; ///< p_max
    double p_bar = 0;        ///< threshold of the variants, except in the sweep
    rough::DatabaseLayout layout;
    std::vector<Answered> database;                    ///< pair by pair, each with every phase column
    std::vector<TargetRun> targets;                    ///< drawn, then held-out
    std::map<std::string, std::string> other_readings; ///< claims under other readings, in words, by id
};

/// A database's genomes with their responses, rescaled to a pressure by Eq. 11.
std::vector<Answered> answered(const std::vector<rough::Genome>& genomes, const rough::Model& model,
                               double max_pressure, int threads);

/// Figure 1: a chromosome with random phases, summed ridge by ridge as in Eq. 1. Its series has M = 8, gamma
/// = 1.5, L = lambda_1 = 0.1 mm, H = 0.8 and A = 1e-2.
struct ChromosomeExample {
    double wave_length; ///< lambda gamma^(1-n), mm
    double misfit;      ///< largest distance of the sum from the best cosine of that wavelength, over its range
};

/// Figure 2: how often the paper's condition (10), |g1| <= sqrt(M + 2 g3), holds for random phases.
struct RidgeCount {
    int ridges;          ///< M >= 2
    double as_printed;   ///< share of phase sets for which it holds as the formula stands, 0..1
    double last_missing; ///< share with the last pair left out of g3 and a negative radicand read as 0
    double right_phase;  ///< share for which Eq. 8's arccos(g1/R) gives the phase of the sum
};
/// For each M, `sets` sets of phases, uniform over a turn.
std::vector<RidgeCount> ridge_study(const std::vector<int>& ridge_counts, int sets, std::uint64_t seed);

/// Figure 3: a profile that is not an MWM series, in octave bands instead of chromosomes. Algorithm 1
/// correlates the K of each band with the whole profile's. The dominant bands make the reduced profile.
/// A band is dominant if its correlation is > 0.95, or if it is the best one and none passes.
struct FractalStudy {
    double similarity; ///< similarity of K(p) of the whole and the reduced profile
    double area_gap;   ///< mean relative difference of their contact fractions
};
/// The reduction of one genome by Algorithm 1.
struct Reduction {
    double kept = 0;        ///< share of the chromosomes that are kept, 0..1
    double similarity = 0;  ///< similarity of K(p) of the reduced and the whole profile at p_max (Eq. 12)
    bool only_best = false; ///< no correlation was above 0.95
};
/// Mean relative change of a genome's curves without half of its waves, at pressures that both profiles
/// reach. NaN if the remaining profile is flat.
struct Removal {
    double stiffness = unknown, area = unknown;
};

/// Nodes in contact, summed over the load steps of a database, and the nodes that left contact later.
struct Contacts {
    double nodes = 0, lost = 0;
};

/// The studies of one genome of the database.
struct GenomeStudy {
    Reduction dominant = {};
    Removal without_coarse = {}, without_fine = {}; ///< without the longer, the shorter half of the waves
    Contacts contacts = {};
};

/// The studies of one run.
struct Studies {
    std::vector<ChromosomeExample> chromosomes = {}; ///< n = 1, 2
    std::vector<RidgeCount> ridges = {};
    std::vector<FractalStudy> fractals = {}; ///< twenty profiles, on the run's grid and body
    std::vector<GenomeStudy> genomes = {};   ///< one per genome of the database
    Findings found = {};                     ///< tables of the chromosomes, the ridges and the first fractal profile
};
Studies studies_of(const PaperRun& run);

/// result.json and tables, those of a second target in the folder heldout.
Findings findings_of(const PaperRun& run, const Studies& studies);

/// A number of each genome's study.
template <class Part, class Value>
std::vector<double> genome_column(const Studies& studies, Part GenomeStudy::*part, Value Part::*value) {
    return rough::column(studies.genomes, [&](const GenomeStudy& one) { return one.*part.*value; });
}

/// Largest difference |b - a| at the points of `a` within the range of `b`; NaN without such points.
double gap(const rough::Curve& a, const rough::Curve& b);

/// The number that a rule is applied to, and the values it comes from, by their names. NaN: not in this run.
struct Finding {
    double number;
    std::vector<std::pair<std::string, double>> parts;
    std::string on = {}; ///< title of the target; "" if the number holds for the whole run

    Finding(double number = unknown, std::vector<std::pair<std::string, double>> parts = {})
        : number(number), parts(std::move(parts)) {}
};

/// A row of experiments/paper/claims.csv. A condition is "> 0.95", ">= 30 and <= 120" or "never".
struct Claim {
    std::string id;
    std::string place;        ///< in the paper, e.g. "Figure 8A"
    std::string sentence;     ///< the paper's words
    std::string measure;      ///< meaning of the number, in words
    std::string number;       ///< its name in claims.cpp, or an expression: "least similarity of sog gco"
    std::string reproduced;   ///< condition on the number of every target
    std::string contradicted; ///< condition on every number; "otherwise": `reproduced` is not met
    std::string remark;

    std::string rule() const; ///< both conditions in words
};

/// The number of a claim for each target, or once.
std::vector<Finding> findings_of(const Claim& claim, const PaperRun& run, const Studies& studies);

/// The claims of the paper, in its order.
const std::vector<Claim>& paper_claims();

/// "reproduced" or "contradicted" if all numbers meet its condition. Otherwise "undecidable": a number is
/// unknown, the list is empty, or the targets differ.
std::string verdict_of(const Claim& claim, const std::vector<double>& numbers);

/// Adds claims.csv, the claims of result.json and the number of each verdict.
void add_claims(Findings& found, const PaperRun& run, const Studies& studies);

/// The variant of that name, or null.
const VariantRun* find_variant(const TargetRun& target, const std::string& name);

/// One candidate's similarity at GCMMA (0), (1) and (2).
struct Refinement {
    std::uint64_t id;
    std::array<double, 3> similarity;
};
/// The candidates of a variant's first "refine", best first, followed by their ids. (2) copies (1) after one
/// refinement only (CCO). Empty if the variant has none.
std::vector<Refinement> refinements(const VariantRun& variant);

/// Figure 4: the genome that is best in a part of the pressures, `low` or `high`. Only genomes whose
/// similarity over all pressures is at most 0.95 are compared.
std::optional<std::size_t> best_in_part(const TargetRun& target, double Scores::*part);

} // namespace app
