#include "apps/experiments/compare/contest.hpp"

#include "ga/observers/coco.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace app {

namespace {

constexpr int moments = 61; // points of a runtime ECDF
constexpr std::size_t resamples = 300;

using Areas = std::vector<std::vector<double>>; // [variant][seed]

std::vector<double> evaluations_of(const std::vector<const Bout*>& bouts) {
    double max_per_gene = 1;
    for (const Bout* bout : bouts)
        max_per_gene = std::max(max_per_gene,
                                static_cast<double>(bout->budget) / static_cast<double>(bout->problem.genes));
    std::vector<double> all;
    for (int i = 0; i < moments; ++i)
        all.push_back(std::pow(max_per_gene, i / (moments - 1.0)));
    return all;
}

/// The share and its interval from the curve of each seed, which is a mean over the problems.
RuntimeShare share_of(const std::vector<std::vector<double>>& of_seed, std::uint64_t seed) {
    RuntimeShare result;
    for (std::size_t at = 0; at < of_seed.front().size(); ++at) {
        const auto mean_of = [&](const std::vector<std::size_t>& picks) {
            return rough::mean(rough::column(picks, [&](std::size_t pick) { return of_seed[pick][at]; }));
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

/// Adds every pair of variants, corrected together. `verifier` gives the difference and its p.
template <class Verifier>
void add_duels(std::vector<Duel>& duels, const std::string& problem, std::size_t variants,
               Verifier verifier) {
    std::vector<Duel> pairs;
    for (std::size_t a = 0; a < variants; ++a)
        for (std::size_t b = a + 1; b < variants; ++b) {
            const auto [difference, p] = verifier(a, b);
            pairs.push_back({problem, a, b, difference, p, p});
        }
    const std::vector<double> corrected = rough::holm(rough::column(pairs, &Duel::p));
    for (std::size_t i = 0; i < corrected.size(); ++i)
        pairs[i].corrected = corrected[i];
    duels.insert(duels.end(), pairs.begin(), pairs.end());
}

void assess_ranks(GroupResult& group) {
    const std::size_t variants = group.shares.size();
    std::vector<std::vector<double>> blocks; // negative areas, because rank 1 is the lowest value
    if (group.areas.size() > 1)
        for (const Areas& problem : group.areas)
            blocks.push_back(rough::column(problem, [](const auto& seeds) { return -rough::mean(seeds); }));
    else // one block per seed, which is an instance
        for (std::size_t s = 0; s < group.areas[0][0].size(); ++s)
            blocks.push_back(rough::column(group.areas[0], [&](const auto& seeds) { return -seeds[s]; }));
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

using nlohmann::json;

/// Whether ert.csv has a target: whole decades and the last target.
bool is_listed(const std::vector<double>& targets, std::size_t k) {
    const double decade = std::log10(targets[k]);
    return k + 1 == targets.size() || std::abs(decade - std::round(decade)) < 1e-9;
}

long reached(const Reached& run) {
    return std::ranges::count_if(run.evaluations, [](double e) { return !std::isnan(e); });
}

/// Whether a variant is better than another over the group ("") or on a problem, after the correction.
bool beats(const GroupResult& group, const std::string& problem, std::size_t better, std::size_t worse) {
    constexpr double significant = 0.05;
    return std::ranges::any_of(group.duels, [&](const Duel& duel) {
        return duel.problem == problem && duel.corrected <= significant &&
               ((duel.first == better && duel.second == worse && duel.difference > 0) ||
                (duel.first == worse && duel.second == better && duel.difference < 0));
    });
}

/// The group's variants, the best mean rank first.
json standing_json(const GroupResult& group) {
    const Contestants& variants = group.bouts.front()->variants;
    const std::string over = group.bouts.size() == 1 ? group.bouts[0]->problem.name : "";
    json rows = json::array();
    const auto order = ga::in_order(variants.size(), [&](std::size_t a, std::size_t b) {
        return group.ranks.mean_ranks[a] < group.ranks.mean_ranks[b];
    });
    for (const std::size_t v : order) {
        std::string better;
        long wins = 0;
        for (const std::size_t other : order) {
            if (beats(group, over, v, other))
                better += (better.empty() ? "" : ", ") + variants[other].first;
            for (const Bout* bout : group.bouts)
                wins += beats(group, bout->problem.name, v, other);
        }
        rows.push_back({{"variant", variants[v].first},
                        {"mean_rank", group.ranks.mean_ranks[v]},
                        {"area", mean_area(group, v)},
                        {"better_than", better},
                        {"wins", wins}});
    }
    return rows;
}

json group_json(const GroupResult& group) {
    const Contestants& variants = group.bouts.front()->variants;
    json result = {{"friedman", {{"statistic", group.ranks.statistic}, {"p", group.ranks.p}}},
                   {"evaluations_per_gene", group.evaluations},
                   {"standing", standing_json(group)}};
    for (const Bout* bout : group.bouts)
        result["problems"].push_back(bout->problem.name);
    for (std::size_t v = 0; v < variants.size(); ++v)
        result["variants"][variants[v].first] = {
            {"pipeline", variants[v].second},       {"mean_rank", group.ranks.mean_ranks[v]},
            {"area", mean_area(group, v)},          {"share", group.shares[v].share},
            {"share_lower", group.shares[v].lower}, {"share_upper", group.shares[v].upper}};
    return result;
}

json bout_json(const Bout& bout) {
    json result = {{"problem", bout.problem.name},
                   {"group", bout.problem.group},
                   {"genes", bout.problem.genes},
                   {"budget", bout.budget},
                   {"targets", bout.problem.targets}};
    for (std::size_t v = 0; v < bout.variants.size(); ++v) {
        json& one = result["variants"][bout.variants[v].first];
        const std::vector<double> precision = rough::column(bout.runs[v], &Reached::precision);
        const rough::Interval interval = rough::median_interval(precision);
        one["median_precision"] = rough::median(precision);
        one["interval"] = {interval.lower, interval.upper};
        one["interval_coverage"] = interval.coverage;
        one["expected_runtime"] = expected_runtime(bout.runs[v], bout.problem.targets.size() - 1);
        one["successes"] = successes(bout.runs[v], bout.problem.targets.size() - 1);
        for (const Reached& run : bout.runs[v])
            one["runs"].push_back({{"evaluations", run.spent},
                                   {"precision", run.precision},
                                   {"evaluations_to_targets", run.evaluations}});
    }
    return result;
}

} // namespace

long successes(const std::vector<Reached>& runs, std::size_t target) {
    return std::ranges::count_if(runs,
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
    std::vector<GroupResult> results;
    for (const Bout& first : contest.bouts) {
        const std::string& name = first.problem.group;
        std::vector<const Bout*> bouts;
        for (const Bout& bout : contest.bouts)
            if (bout.problem.group == name)
                bouts.push_back(&bout);
        if (bouts.front() == &first) // otherwise the group is done
            results.push_back(group_of(name, bouts, contest));
    }
    return results;
}

void write_coco_runs(const Contest& contest, const std::filesystem::path& folder) {
    std::map<std::string, std::vector<ga::CocoFunction>> of_variant;
    for (const Bout& bout : contest.bouts) {
        int dimension = 0, function = 0;
        if (std::sscanf(bout.problem.name.c_str(), "bbob%d-%d", &dimension, &function) != 2)
            continue;
        for (std::size_t v = 0; v < bout.variants.size(); ++v) {
            ga::CocoFunction one{function, bout.problem.genes, {}};
            for (std::size_t s = 0; s < bout.runs[v].size(); ++s)
                one.runs.push_back(
                    {instance_of(contest.origin.seed + s), bout.runs[v][s].found, bout.runs[v][s].spent});
            of_variant[bout.variants[v].first].push_back(std::move(one));
        }
    }
    for (const auto& [name, functions] : of_variant) {
        std::string plain = name;
        std::ranges::replace_if(
            plain, [](unsigned char c) { return !std::isalnum(c) && c != '-'; }, '_');
        ga::write_coco(folder / plain, plain, functions);
    }
}

Findings findings_of(const Contest& contest, const std::vector<GroupResult>& groups) {
    Findings found{.result = {{"seeds", contest.seeds}, {"budget", contest.budget}}};
    Csv &runs = found.table("runs.csv", "problem,variant,seed,evaluations,precision,targets_reached,area"),
        &ert = found.table("ert.csv", "problem,variant,precision,expected_runtime,successes,runs", 6),
        &ecdf = found.table("ecdf.csv", "group,variant,evaluations_per_gene,share,lower,upper", 6),
        &tests = found.table("tests.csv", "group,problem,first,second,area_difference,p,p_corrected", 6);
    for (const GroupResult& group : groups) {
        found.result["groups"][group.name] = group_json(group);
        const Contestants& variants = group.bouts.front()->variants;
        for (std::size_t k = 0; k < group.bouts.size(); ++k) {
            const Bout& bout = *group.bouts[k];
            found.result["problems"][bout.problem.name] = bout_json(bout);
            for (std::size_t v = 0; v < variants.size(); ++v) {
                for (std::size_t s = 0; s < bout.runs[v].size(); ++s) {
                    const Reached& run = bout.runs[v][s];
                    runs.row(bout.problem.name, variants[v].first, contest.origin.seed + s, run.spent,
                             run.precision, reached(run), group.areas[k][v][s]);
                }
                for (std::size_t t = 0; t < bout.problem.targets.size(); ++t)
                    if (is_listed(bout.problem.targets, t))
                        ert.row(bout.problem.name, variants[v].first, bout.problem.targets[t],
                                expected_runtime(bout.runs[v], t), successes(bout.runs[v], t), contest.seeds);
            }
        }
        for (std::size_t v = 0; v < variants.size(); ++v)
            for (std::size_t i = 0; i < group.evaluations.size(); ++i)
                ecdf.row(group.name, variants[v].first, group.evaluations[i], group.shares[v].share[i],
                         group.shares[v].lower[i], group.shares[v].upper[i]);
        for (const Duel& duel : group.duels)
            tests.row(group.name, duel.problem, variants[duel.first].first, variants[duel.second].first,
                      duel.difference, duel.p, duel.corrected);
    }
    return found;
}

} // namespace app
