#include "apps/experiments/paper/claims.hpp"

#include <algorithm>

namespace app {

Studies studies_of(const PaperRun& run) {
    constexpr int phase_sets = 1000; // as many as the paper's Figure 2
    const std::vector<int> ridges = {2,  3,  4,   6,   8,   12,  16,  24,  32,  48,
                                     64, 96, 128, 192, 256, 384, 512, 768, 1024};
    return {{chromosome_example(1, run.origin.seed), chromosome_example(2, run.origin.seed)},
            ridge_study(ridges, phase_sets, run.origin.seed),
            fractal_studies(run.model, run.origin.seed, run.origin.threads),
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
