#pragma once

#include "apps/experiments/paper/studies.hpp"

namespace app {

enum class Verdict { reproduced, contradicted, undecidable };
/// "reproduced", "contradicted" or "undecidable"
const char* name_of(Verdict verdict);

/// The number that a rule is applied to, and the values it comes from, by their names. NaN: not in this run.
struct Finding {
    double number;
    std::vector<std::pair<std::string, double>> parts;
    std::string on = {}; ///< title of the target; "" if the number holds for the whole run

    Finding(double number = unknown, std::vector<std::pair<std::string, double>> parts = {})
        : number(number), parts(std::move(parts)) {}
};

/// A row of apps/experiments/paper/claims.csv. A condition is "> 0.95", ">= 30 and <= 120" or "never".
struct Claim {
    std::string id;
    std::string place;        ///< in the paper, e.g. "Figure 8A"
    std::string sentence;     ///< the paper's words
    std::string measure;      ///< meaning of the number, in words
    std::string number;       ///< its name in measures.cpp, or an expression: "least similarity of sog gco"
    std::string reproduced;   ///< condition on the number of every target
    std::string contradicted; ///< condition on every number; "otherwise": `reproduced` is not met
    std::string remark;

    std::string rule() const; ///< both conditions in words
};

/// The number of a claim for each target, or once.
std::vector<Finding> findings_of(const Claim& claim, const PaperRun& run, const Studies& studies);

/// The claims of the paper, in its order.
const std::vector<Claim>& paper_claims();

/// The verdict whose condition all numbers meet. Undecidable if a number is unknown, if the list is empty, or
/// if the targets differ.
Verdict verdict_of(const Claim& claim, const std::vector<double>& numbers);

/// Adds claims.csv to the tables; returns the claims for result.json and the number of each verdict.
nlohmann::json claims_json(const PaperRun& run, const Studies& studies, Findings& found);

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

/// Figure 4: among genomes whose similarity over all pressures is at most 0.95, the one that is best over the
/// low (or high) pressures.
std::optional<std::size_t> best_in_part(const TargetRun& target, bool low);

} // namespace app
