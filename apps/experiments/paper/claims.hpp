#pragma once

#include "apps/experiments/paper/chromosome_example.hpp"
#include "apps/experiments/paper/fractal_study.hpp"
#include "apps/experiments/paper/readings.hpp"
#include "apps/experiments/paper/ridge_study.hpp"
#include "apps/experiments/paper/run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace app {

enum class Verdict { reproduced, contradicted, undecidable };

/// One thing the paper says, beside what was measured here. Texts are HTML.
struct Claim {
    std::string place;    ///< e.g. "Figure 7"
    std::string says;     ///< the paper
    std::string measured; ///< here, with numbers
    std::string rule;     ///< from the numbers to the verdict
    Verdict verdict = Verdict::undecidable;
};

/// What is measured beside the run for the claims that no search bears on.
struct Studies {
    std::vector<ChromosomeExample> chromosomes; ///< n = 1, 2
    std::vector<RidgeCount> ridges;
    std::vector<FractalStudy> fractals; ///< one a profile
    Readings readings;
};
Studies studies_of(const PaperRun& run);

std::vector<Claim> formula_claims(const Studies& studies); ///< Figures 1 and 2, Eq. 8
std::vector<Claim> part_claims(const Studies& studies);    ///< Figure 3 and sections 1, 2.3
std::vector<Claim> database_claims(const PaperRun& run);   ///< Figures 4 to 6 and section 4
std::vector<Claim> series_claims(const PaperRun& run, const Studies& studies); ///< all these
std::vector<Claim> search_claims(const PaperRun& run);                         ///< Figures 7 and 8
std::vector<Claim> answer_claims(const PaperRun& run);                         ///< Figures 9 to 11

/// All of them, in the paper's order.
std::vector<Claim> paper_claims(const PaperRun& run, const Studies& studies);

/// How the rule of a claim ends that holds or not on each target.
inline const std::string both = " on every target; contradicted if on none.";

/// True, false or unknown for each target: all true is reproduced, all false contradicted; undecidable where
/// it depends on the target or nothing is known.
Verdict verdict_over(const std::vector<std::optional<bool>>& targets);

} // namespace app
