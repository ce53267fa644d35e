#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace app {

namespace {

constexpr double noticeable = 0.01; ///< a change of similarity that Figure 8 would show

/// What one target says of a claim: in words, and whether it holds (unknown where the run has no such data).
struct Finding {
    std::string words;
    std::optional<bool> holds;
};

Claim over_targets(const PaperRun& run, Claim claim, const std::function<Finding(const TargetRun&)>& find) {
    std::vector<std::optional<bool>> holds;
    for (const TargetRun& target : run.targets) {
        const Finding finding = find(target);
        claim.measured += (claim.measured.empty() ? "" : "; ") + target.title + ": " +
                          (finding.words.empty() ? "not in this run" : finding.words);
        holds.push_back(finding.holds);
    }
    claim.measured += ".";
    claim.verdict = verdict_over(holds);
    return claim;
}

/// The three algorithms' variants, or nothing if one is missing.
std::vector<const VariantRun*> the_three(const TargetRun& target) {
    std::vector<const VariantRun*> found;
    for (const Algorithm& algorithm : algorithms)
        if (const VariantRun* variant = find_variant(target, algorithm.name))
            found.push_back(variant);
    return found.size() == algorithms.size() ? found : std::vector<const VariantRun*>{};
}

Finding large(const TargetRun& target) {
    Finding finding;
    for (const VariantRun* variant : the_three(target)) {
        finding.words += (finding.words.empty() ? "" : ", ") + readable(variant->similarity);
        finding.holds = finding.holds.value_or(true) && variant->similarity >= 0.9;
    }
    return finding;
}

Finding beneficial(const TargetRun& target) {
    int better = 0, all = 0;
    std::vector<double> gains;
    for (const VariantRun* variant : the_three(target))
        for (const Refinement& candidate : refinements(*variant)) {
            gains.push_back(candidate.similarity[2] - candidate.similarity[0]);
            better += gains.back() > 0;
            ++all;
        }
    if (all == 0)
        return {};
    return {std::to_string(better) + " of " + std::to_string(all) + " candidates gained, by " +
                readable(rough::median(gains), 2) + " in the median",
            better == all};
}

Finding a_minute(const TargetRun& target) {
    Finding finding;
    for (const VariantRun* variant : the_three(target)) {
        finding.words += (finding.words.empty() ? "" : ", ") + readable(variant->seconds, 2) + " s";
        finding.holds = finding.holds.value_or(true) && variant->seconds <= 60;
    }
    return finding;
}

/// Of one algorithm's rows over the thresholds.
template <class Value>
std::vector<double> over_thresholds(const TargetRun& target, const std::string& variant, Value value) {
    return rough::column(thresholds_of(target, variant), value);
}

double spread(const std::vector<double>& values) {
    if (values.empty())
        return unset;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least;
}

double best_spread(const TargetRun& target, const std::string& variant) {
    return spread(over_thresholds(target, variant, &ThresholdRow::similarity));
}

Finding varies(const TargetRun& target, const std::string& variant, bool wanted) {
    const double width = best_spread(target, variant);
    if (std::isnan(width))
        return {};
    return {"best s spans " + readable(width, 2), (width > noticeable) == wanted};
}

Finding same_parents(const TargetRun& target) {
    std::set<std::vector<std::uint64_t>> pairs;
    for (ThresholdRow& row : thresholds_of(target, "cco")) {
        std::sort(row.parents.begin(), row.parents.end());
        pairs.insert(row.parents);
    }
    if (pairs.empty())
        return {};
    return {std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair" : " pairs") + " of parents over " +
                std::to_string(thresholds_of(target, "cco").size()) + " thresholds",
            pairs.size() == 1};
}

double children(const ThresholdRow& row) { return static_cast<double>(row.u1 * row.u2); }

Finding size_varies(const TargetRun& target) {
    const auto sizes = over_thresholds(target, "gco", children);
    if (sizes.empty())
        return {};
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    return {"from " + readable(*least, 1) + " to " + readable(*most, 1), *most > *least};
}

Finding equal_size(const TargetRun& target) {
    const auto gco = over_thresholds(target, "gco", children), cco = over_thresholds(target, "cco", children);
    if (gco.empty() || gco.size() != cco.size())
        return {};
    int equal = 0;
    for (std::size_t i = 0; i < gco.size(); ++i)
        equal += gco[i] == cco[i];
    return {"equal at " + std::to_string(equal) + " of " + std::to_string(gco.size()) + " thresholds",
            equal == static_cast<int>(gco.size())};
}

Finding more_efficient(const TargetRun& target) {
    const auto gco = over_thresholds(target, "gco", &ThresholdRow::share_above),
               cco = over_thresholds(target, "cco", &ThresholdRow::share_above);
    if (gco.empty() || cco.empty())
        return {};
    return {"mean share above 0.95: GCO " + percent(rough::mean(gco), 2) + ", CCO " +
                percent(rough::mean(cco), 2),
            rough::mean(gco) == rough::mean(cco) ? std::nullopt
                                                 : std::optional(rough::mean(gco) > rough::mean(cco))};
}

} // namespace

std::vector<Claim> search_claims(const PaperRun& run) {
    return {
        over_targets(run,
                     {"Figure 7", "The three algorithms reach large similarities.", "",
                      "Each answer's s ≥ 0.9" + both},
                     large),
        over_targets(run,
                     {"Figure 7", "GCMMA is beneficial for all candidates.", "",
                      "s after (2) above s at (0) for all three candidates of all three algorithms" + both},
                     beneficial),
        over_targets(
            run, {"Section 4", "Each algorithm takes about a minute.", "", "At most a minute each" + both},
            a_minute),
        over_targets(run,
                     {"Figure 8A", "GCO's best similarity varies significantly with p̄.", "",
                      "It spans more than 0.01" + both},
                     [](const TargetRun& target) { return varies(target, "gco", true); }),
        over_targets(run, {"Figure 8A", "CCO's does not.", "", "It spans at most 0.01" + both},
                     [](const TargetRun& target) { return varies(target, "cco", false); }),
        over_targets(run,
                     {"Figure 8A", "CCO's best keeps the same parents.", "", "One pair of parents" + both},
                     same_parents),
        over_targets(run, {"Figure 8B", "|U<sub>3</sub>| varies with p̄.", "", "More than one size" + both},
                     size_varies),
        over_targets(
            run, {"Figure 8B", "|U<sub>3</sub>| is equal for GCO and CCO.", "", "Equal at every p̄" + both},
            equal_size),
        over_targets(run,
                     {"Figure 8B", "GCO is the more efficient one.", "",
                      "GCO's mean share of children with s > 0.95 exceeds CCO's" + both},
                     more_efficient),
    };
}

} // namespace app
