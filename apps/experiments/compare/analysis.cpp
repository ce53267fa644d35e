#include "apps/experiments/compare/contest.hpp"
#include "ga/base/random.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr int moments = 61; // of a runtime ECDF
constexpr std::size_t resamples = 300;

using Areas = std::vector<std::vector<double>>; // [variant][seed]

/// Less is better, as ranks count from the smallest.
std::vector<double> negative(std::vector<double> values) {
    for (double& value : values)
        value = -value;
    return values;
}

std::vector<double> evaluations_of(const std::vector<const Bout*>& bouts) {
    double most = 1;
    for (const Bout* bout : bouts)
        most = std::max(most, static_cast<double>(bout->budget) / static_cast<double>(bout->problem.genes));
    std::vector<double> all;
    for (int i = 0; i < moments; ++i)
        all.push_back(std::pow(most, i / (moments - 1.0)));
    return all;
}

/// The curve of each seed, the mean over the problems, gives the group's and its resamples.
RuntimeShare share_of(const std::vector<std::vector<double>>& of_seed, std::uint64_t seed) {
    RuntimeShare result;
    for (std::size_t at = 0; at < of_seed.front().size(); ++at) {
        const auto mean_of = [&](const std::vector<std::size_t>& picks) {
            double sum = 0;
            for (const std::size_t pick : picks)
                sum += of_seed[pick][at];
            return sum / static_cast<double>(picks.size());
        };
        const rough::Interval interval =
            rough::bootstrap_interval(of_seed.size(), mean_of, resamples, 0.95, seed);
        result.share.push_back(
            rough::mean(rough::column(of_seed, [&](const auto& curve) { return curve[at]; })));
        result.lower.push_back(interval.lower);
        result.upper.push_back(interval.upper);
    }
    return result;
}

/// Every pair of variants, corrected together. `p_of` gives the difference and its p.
template <class Verifier>
void add_duels(std::vector<Duel>& duels, const std::string& problem, std::size_t variants,
               Verifier verifier) {
    std::vector<double> p;
    const std::size_t first = duels.size();
    for (std::size_t a = 0; a < variants; ++a)
        for (std::size_t b = a + 1; b < variants; ++b) {
            const auto [difference, chance] = verifier(a, b);
            duels.push_back({problem, a, b, difference, chance, chance});
            p.push_back(chance);
        }
    const std::vector<double> corrected = rough::holm(p);
    for (std::size_t i = 0; i < corrected.size(); ++i)
        duels[first + i].corrected = corrected[i];
}

void assess_ranks(GroupResult& group) {
    const std::size_t variants = group.shares.size();
    std::vector<std::vector<double>> blocks;
    for (const Areas& problem : group.areas)
        blocks.push_back(
            negative(rough::column(problem, [](const auto& seeds) { return rough::mean(seeds); })));
    if (blocks.size() == 1) { // its seeds, each an instance
        blocks.clear();
        for (std::size_t s = 0; s < group.areas[0][0].size(); ++s)
            blocks.push_back(
                negative(rough::column(group.areas[0], [&](const auto& seeds) { return seeds[s]; })));
    }
    group.ranks = rough::friedman(blocks);
    if (group.areas.size() > 1)
        add_duels(group.duels, "", variants, [&](std::size_t a, std::size_t b) {
            std::vector<double> differences;
            for (const auto& block : blocks)
                differences.push_back(block[b] - block[a]);
            return std::pair(rough::mean(differences), rough::signed_rank_p(differences));
        });
    for (std::size_t k = 0; k < group.areas.size(); ++k)
        add_duels(group.duels, group.bouts[k]->problem.name, variants, [&](std::size_t a, std::size_t b) {
            const Areas& areas = group.areas[k];
            return std::pair(rough::mean(areas[a]) - rough::mean(areas[b]),
                             rough::rank_sum_p(areas[a], areas[b]));
        });
}

GroupResult group_of(const std::string& name, const std::vector<const Bout*>& bouts, const Contest& contest) {
    GroupResult group{name, bouts, evaluations_of(bouts), {}, {}, {}, {}};
    const std::size_t variants = bouts.front()->variants.size(),
                      seeds = static_cast<std::size_t>(contest.seeds);
    group.areas.assign(bouts.size(), Areas(variants, std::vector<double>(seeds)));
    for (std::size_t v = 0; v < variants; ++v) {
        std::vector<std::vector<double>> of_seed(seeds, std::vector<double>(group.evaluations.size(), 0.0));
        for (std::size_t k = 0; k < bouts.size(); ++k)
            for (std::size_t s = 0; s < seeds; ++s) {
                const double genes = static_cast<double>(bouts[k]->problem.genes);
                std::vector<double> curve;
                for (const double at : group.evaluations)
                    curve.push_back(
                        rough::share_up_to(bouts[k]->runs[v][s].evaluations, at * genes * (1 + 1e-9)));
                group.areas[k][v][s] = rough::mean(curve);
                for (std::size_t at = 0; at < curve.size(); ++at)
                    of_seed[s][at] += curve[at] / static_cast<double>(bouts.size());
            }
        group.shares.push_back(share_of(of_seed, ga::fold(contest.origin.seed, name)));
    }
    assess_ranks(group);
    return group;
}

} // namespace

long successes(const std::vector<Reached>& runs, std::size_t target) {
    return std::count_if(runs.begin(), runs.end(),
                         [&](const Reached& run) { return !std::isnan(run.evaluations[target]); });
}

double expected_runtime(const std::vector<Reached>& runs, std::size_t target) {
    double sum = 0;
    for (const Reached& run : runs)
        sum += std::isnan(run.evaluations[target]) ? static_cast<double>(run.spent) : run.evaluations[target];
    return sum / static_cast<double>(successes(runs, target));
}

double mean_area(const GroupResult& group, std::size_t variant) {
    return rough::mean(
        rough::column(group.areas, [&](const Areas& areas) { return rough::mean(areas[variant]); }));
}

std::vector<GroupResult> analysed(const Contest& contest) {
    std::vector<std::pair<std::string, std::vector<const Bout*>>> groups;
    for (const Bout& bout : contest.bouts) {
        auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const auto& group) { return group.first == bout.problem.group; });
        if (found == groups.end())
            found = groups.insert(found, {bout.problem.group, {}});
        found->second.push_back(&bout);
    }
    std::vector<GroupResult> results;
    for (const auto& [name, bouts] : groups)
        results.push_back(group_of(name, bouts, contest));
    return results;
}

} // namespace app
