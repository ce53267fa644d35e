#include "apps/report/claims.hpp"

#include <algorithm>

namespace app {

Studies studies_of(const PaperRun& run) {
    constexpr int most_ridges = 20, phase_sets = 1000; // the paper's Figure 2 takes 1,000 sets
    return {{chromosome_example(1, run.seed), chromosome_example(2, run.seed)},
            ridge_study(most_ridges, phase_sets, run.seed),
            fractal_study(run.model, run.seed),
            readings_of(run)};
}

std::vector<Claim> paper_claims(const PaperRun& run, const Studies& studies) {
    std::vector<Claim> claims;
    for (const auto& part : {series_claims(run, studies), search_claims(run), answer_claims(run)})
        claims.insert(claims.end(), part.begin(), part.end());
    return claims;
}

Verdict verdict_over(const std::vector<std::optional<bool>>& targets) {
    const auto all = [&](bool wanted) {
        return !targets.empty() && std::all_of(targets.begin(), targets.end(),
                                               [&](const auto& holds) { return holds == wanted; });
    };
    return all(true) ? Verdict::reproduced : all(false) ? Verdict::contradicted : Verdict::undecidable;
}

} // namespace app
