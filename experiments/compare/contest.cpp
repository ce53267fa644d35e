#include "experiments/compare/contest.hpp"

#include "apps/prompt/units.hpp"
#include "domain/numerics/statistics.hpp"
#include "ga/observers/coco.hpp"

#include <boost/algorithm/string/join.hpp>

#include <cstdio>

namespace app {
namespace {

using nlohmann::json;
using Areas = std::vector<std::vector<double>>; // [variant][seed]

constexpr double significant = 0.05; ///< p up to which one variant is better than another

/// The problems of a group together.
struct Group {
    std::string name;
    std::vector<const ProblemResults*> results = {};
    /// For each problem: the mean share of targets that a run has reached, over the evaluations on a
    /// logarithmic scale. At 1 all targets are reached at once, at 0 none ever. Ranks and tests use these.
    std::vector<Areas> areas = {};

    const Contestants& variants() const { return results.front()->variants; }
};

std::vector<Group> groups_of(const Contest& contest) {
    std::vector<Group> groups;
    for (const ProblemResults& results : contest.results) {
        auto group = std::ranges::find(groups, results.problem.group, &Group::name);
        if (group == groups.end()) group = groups.insert(group, {results.problem.group});
        group->results.push_back(&results);
    }
    return groups;
}

/// COCO's runtime ECDF of each variant: the share of all pairs of run and target that are reached, against
/// the evaluations per gene. The 95 % interval is by bootstrap over the seeds. Sets the group's areas.
void add_shares(Findings& found, Group& group, const Contest& contest) {
    constexpr int moments = 61; // points of an ECDF
    constexpr std::size_t resamples = 300;
    Csv& table = found.table("ecdf.csv", "group,variant,evaluations_per_gene,share,lower,upper", 6);
    double max_per_gene = 1;
    for (const ProblemResults* results : group.results)
        max_per_gene =
            std::max(max_per_gene, static_cast<double>(results->budget) / static_cast<double>(results->problem.genes));
    std::vector<double> evaluations;
    for (int i = 0; i < moments; ++i) evaluations.push_back(std::pow(max_per_gene, i / (moments - 1.0)));
    json& result = found.result["groups"][group.name];
    result["evaluations_per_gene"] = evaluations;
    const auto seeds = static_cast<std::size_t>(contest.seeds);
    group.areas.assign(group.results.size(), Areas(group.variants().size(), std::vector<double>(seeds)));
    for (std::size_t v = 0; v < group.variants().size(); ++v) {
        const std::string& name = group.variants()[v].first;
        std::vector<std::vector<double>> of_seed(seeds, std::vector<double>(moments)); // means over problems
        for (std::size_t k = 0; k < group.results.size(); ++k)
            for (std::size_t s = 0; s < seeds; ++s) {
                const ProblemResults& results = *group.results[k];
                const double genes = static_cast<double>(results.problem.genes);
                const auto curve = rough::column(evaluations, [&](double at) {
                    return rough::share_up_to(results.runs[v][s].evaluations, at * genes * (1 + 1e-9));
                });
                group.areas[k][v][s] = rough::mean(curve);
                for (std::size_t at = 0; at < curve.size(); ++at)
                    of_seed[s][at] += curve[at] / static_cast<double>(group.results.size());
            }
        json& variant = result["variants"][name];
        for (std::size_t at = 0; at < evaluations.size(); ++at) {
            const auto mean_of = [&](const std::vector<std::size_t>& picks) {
                return rough::mean(rough::column(picks, [&](std::size_t pick) { return of_seed[pick][at]; }));
            };
            const double share = rough::mean(rough::column(of_seed, [&](const auto& curve) { return curve[at]; }));
            const rough::Interval interval =
                rough::bootstrap_interval(seeds, mean_of, resamples, 0.95, ga::fold(contest.origin.seed, group.name));
            variant["share"].push_back(share);
            variant["share_lower"].push_back(interval.lower);
            variant["share_upper"].push_back(interval.upper);
            table.row(group.name, name, evaluations[at], share, interval.lower, interval.upper);
        }
    }
}

/// Friedman's test, signed ranks over problems, and rank sums over a problem's seeds, as rows of tests.csv.
std::vector<json> add_tests(Findings& found, const Group& group) {
    Csv& table = found.table("tests.csv", "group,problem,first,second,area_difference,p,p_corrected", 6);
    json& result = found.result["groups"][group.name];
    const Contestants& variants = group.variants();
    const bool has_several = group.areas.size() > 1;
    std::vector<std::vector<double>> blocks; // negative areas, because rank 1 is the lowest value
    if (has_several)
        for (const Areas& problem : group.areas)
            blocks.push_back(rough::column(problem, [](const auto& seeds) { return -rough::mean(seeds); }));
    else // one block per seed, which is an instance
        for (std::size_t s = 0; s < group.areas[0][0].size(); ++s)
            blocks.push_back(rough::column(group.areas[0], [&](const auto& seeds) { return -seeds[s]; }));
    const rough::Friedman ranks = rough::friedman(blocks);
    result["friedman"] = {{"statistic", ranks.statistic}, {"p", ranks.p}};
    for (std::size_t v = 0; v < variants.size(); ++v)
        result["variants"][variants[v].first].update(
            {{"pipeline", variants[v].second},
             {"mean_rank", ranks.mean_ranks[v]},
             {"area", rough::mean(rough::column(group.areas, [&](const Areas& of) { return rough::mean(of[v]); }))}});

    std::vector<json> rows;
    // Adds every pair of variants, corrected together. `test` gives the difference and its p.
    const auto add_pairs = [&](const std::string& problem, auto test) {
        const std::size_t before = rows.size();
        std::vector<double> uncorrected;
        for (std::size_t a = 0; a < variants.size(); ++a)
            for (std::size_t b = a + 1; b < variants.size(); ++b) {
                const auto [difference, p] = test(a, b);
                uncorrected.push_back(p);
                rows.push_back({{"group", group.name},
                                {"problem", problem},
                                {"first", variants[a].first},
                                {"second", variants[b].first},
                                {"area_difference", difference},
                                {"p", p}});
            }
        const std::vector<double> corrected = rough::holm(uncorrected);
        for (std::size_t i = 0; i < corrected.size(); ++i) {
            rows[before + i]["p_corrected"] = corrected[i];
            table.add(rows[before + i]);
        }
    };
    if (has_several)
        add_pairs("", [&](std::size_t a, std::size_t b) {
            const auto differences = rough::column(blocks, [&](const auto& block) { return block[b] - block[a]; });
            return std::pair(rough::mean(differences), rough::signed_rank_p(differences));
        });
    for (std::size_t k = 0; k < group.areas.size(); ++k)
        add_pairs(group.results[k]->problem.name, [&](std::size_t a, std::size_t b) {
            const Areas& areas = group.areas[k];
            return std::pair(rough::mean(areas[a]) - rough::mean(areas[b]), rough::rank_sum_p(areas[a], areas[b]));
        });
    return rows;
}

/// Adds the group's variants, the best mean rank first. `tests` are the group's rows of tests.csv.
void add_standing(Findings& found, const Group& group, const std::vector<json>& tests) {
    const std::string only_problem = group.results.size() == 1 ? group.results[0]->problem.name : "";
    std::map<std::string, long> wins;                    // on problems, by variant
    std::map<std::string, std::set<std::string>> beaten; // variants that are worse in the group
    for (const json& row : tests) {
        const double difference = row["area_difference"];
        if (row["p_corrected"].get<double>() > significant || difference == 0) continue;
        const std::string winner = row[difference > 0 ? "first" : "second"], problem = row["problem"];
        wins[winner] += !problem.empty();
        if (problem == only_problem) beaten[winner].insert(row[difference > 0 ? "second" : "first"]);
    }
    json& result = found.result["groups"][group.name];
    auto names = names_of(group.variants());
    std::ranges::stable_sort(
        names, {}, [&](const std::string& name) { return result["variants"][name]["mean_rank"].get<double>(); });
    for (const std::string& name : names) {
        std::string better;
        for (const std::string& other : names)
            if (beaten[name].contains(other)) better += (better.empty() ? "" : ", ") + other;
        const json& variant = result["variants"][name];
        result["standing"].push_back({{"variant", name},
                                      {"mean_rank", variant["mean_rank"]},
                                      {"area", variant["area"]},
                                      {"better_than", better},
                                      {"wins", wins[name]}});
    }
}

/// Whether ert.csv has a target: whole decades and the last target.
bool is_listed(const std::vector<double>& targets, std::size_t k) {
    const double decade = std::log10(targets[k]);
    return k + 1 == targets.size() || std::abs(decade - std::round(decade)) < 1e-9;
}

long reached(const Reached& run) {
    return std::ranges::count_if(run.evaluations, [](double e) { return !std::isnan(e); });
}

/// Adds the group's problems with all runs.
void add_problems(Findings& found, const Group& group, const Contest& contest) {
    Csv &all = found.table("runs.csv", "problem,variant,seed,evaluations,precision,targets_reached,area,hypervolume"),
        &ert = found.table("ert.csv", "problem,variant,precision,expected_runtime,successes,runs", 6);
    for (std::size_t k = 0; k < group.results.size(); ++k) {
        const ProblemResults& results = *group.results[k];
        const std::string& problem = results.problem.name;
        const std::vector<double>& targets = results.problem.targets;
        found.result["groups"][group.name]["problems"].push_back(problem);
        json& result = found.result["problems"][problem];
        result = {{"problem", problem},
                  {"group", group.name},
                  {"genes", results.problem.genes},
                  {"budget", results.budget},
                  {"targets", targets}};
        for (std::size_t v = 0; v < results.variants.size(); ++v) {
            const std::string& name = results.variants[v].first;
            const std::vector<Reached>& runs = results.runs[v];
            const std::vector<double> precision = rough::column(runs, &Reached::precision);
            const rough::Interval interval = rough::median_interval(precision);
            json& one = result["variants"][name];
            one = {{"median_precision", rough::median(precision)},
                   {"interval", {interval.lower, interval.upper}},
                   {"expected_runtime", expected_runtime(runs, targets.size() - 1)},
                   {"successes", successes(runs, targets.size() - 1)}};
            if (results.problem.kind == "fronts")
                one["median_hypervolume"] = rough::median(rough::column(runs, &Reached::hypervolume));
            for (std::size_t s = 0; s < runs.size(); ++s) {
                one["runs"].push_back({{"evaluations", runs[s].spent},
                                       {"precision", runs[s].precision},
                                       {"evaluations_to_targets", runs[s].evaluations}});
                all.row(problem, name, contest.origin.seed + s, runs[s].spent, runs[s].precision, reached(runs[s]),
                        group.areas[k][v][s], runs[s].hypervolume);
            }
            for (std::size_t t = 0; t < targets.size(); ++t)
                if (is_listed(targets, t))
                    ert.row(problem, name, targets[t], expected_runtime(runs, t), successes(runs, t), contest.seeds);
        }
    }
}

/// The median over the runs of the best precision so far, with its interval, against the evaluations.
void add_progress(Findings& found, const ProblemResults& results) {
    constexpr int moments = 60;
    constexpr double first = 10;
    Csv& table = found.table("progress.csv", "problem,variant,evaluations,precision,lower,upper", 6);
    for (std::size_t v = 0; v < results.variants.size(); ++v)
        for (int i = 0; i < moments; ++i) {
            const double at = first * std::pow(static_cast<double>(results.budget) / first, i / (moments - 1.0));
            const auto best = rough::column(results.runs[v], [&](const Reached& run) {
                double precision = HUGE_VAL;
                for (const auto& [evaluations, after] : run.found)
                    if (static_cast<double>(evaluations) <= at) precision = after;
                return precision;
            });
            const rough::Interval interval = rough::median_interval(best);
            if (std::isfinite(interval.upper))
                table.row(results.problem.name, results.variants[v].first, at, rough::median(best), interval.lower,
                          interval.upper);
        }
}

/// Heights and last contact pressure of a designed map, on at most 128 x 128 nodes.
void add_map(Findings& found, const ProblemResults& results, const json& designed) {
    Csv& table = found.table("surfaces.csv", "problem,x_mm,y_mm,height_mm,pressure_MPa", 6);
    const rough::Model& model = results.problem.setup->model;
    const rough::Grid& grid = model.grid;
    const rough::Profile surface = sample(rough::genome_from_json(designed["genome"], "genome"), grid);
    rough::ContactOptions options = model.contact;
    options.states = true;
    const auto state = solve_contact(surface, model.body, {designed["last_displacement_mm"]}, options).states[0];
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(surface.nodes());
    pressure(state.nodes) = state.pressure;
    const rough::Index every = 1 + (std::max(grid.nodes, grid.rows) - 1) / 128;
    for (rough::Index j = 0; j < grid.rows; j += every)
        for (rough::Index i = 0; i < grid.nodes; i += every)
            table.row(results.problem.name, static_cast<double>(i) * grid.spacing(),
                      static_cast<double>(j) * grid.row_spacing(), surface.heights[j * grid.nodes + i],
                      pressure[j * grid.nodes + i]);
}

/// Adds the set-up of a roughness problem and the answers of its variants, the best median first. Returns the
/// verdict: this variant, and those that rank sums do not tell from it.
std::string add_surfaces(Findings& found, const ProblemResults& results) {
    Csv& table =
        found.table("answers.csv", "problem,variant,similarity_worst,lower,upper,p,price,curves,gradients,seconds", 6);
    const std::string& problem = results.problem.name;
    const rough::DesignSetup& setup = *results.problem.setup;
    json of_problem = model_json(setup.model);
    of_problem.update({{"max_pressure_MPa", setup.max_pressure ? json(*setup.max_pressure) : json()},
                       {"target", target_json(setup.targets[0])},
                       {"is_2d", setup.model.grid.is_2d()},
                       {"ridges", setup.ridges}});
    found.result["problems"][problem].update(of_problem);
    of_problem["problem"] = problem;
    found.result["surfaces"].push_back(of_problem);
    std::vector<std::vector<double>> similarities; // [variant][seed]
    for (const std::vector<Reached>& runs : results.runs)
        similarities.push_back(
            rough::column(runs, [](const Reached& run) { return run.surface.at("similarity_worst").get<double>(); }));
    // The surface of the run with the median of the similarities, or the next below.
    const auto median_surface = [&](std::size_t v) -> const json& {
        return results.runs[v][rough::ascending(similarities[v])[(similarities[v].size() - 1) / 2]].surface;
    };
    const auto order = rough::ascending(rough::column(similarities, [](const auto& of) { return -rough::median(of); }));
    std::vector<double> p = rough::holm(rough::column(std::vector(order.begin() + 1, order.end()), [&](std::size_t v) {
        return rough::rank_sum_p(similarities[order[0]], similarities[v]);
    }));
    p.insert(p.begin(), NAN);
    std::vector<std::string> not_different;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const std::size_t v = order[rank];
        const std::string& name = results.variants[v].first;
        const double median = rough::median(similarities[v]);
        const rough::Interval interval = rough::median_interval(similarities[v]);
        if (p[rank] > significant) not_different.push_back(name);
        const json& middle = median_surface(v);
        json& one = found.result["problems"][problem]["variants"][name];
        one.update(middle);
        one["median_lowest"] = median;
        one["median_lowest_interval"] = {interval.lower, interval.upper};
        table.row(problem, name, median, interval.lower, interval.upper, p[rank], middle["price"], middle["curves"],
                  middle["gradients"], middle["seconds"]);
    }
    add_progress(found, results);
    if (setup.model.grid.is_2d()) add_map(found, results, median_surface(order[0]));
    return problem + ": the highest median is that of " + results.variants[order[0]].first + ", " +
           readable(rough::median(similarities[order[0]]), 4) +
           (not_different.empty() ? "" : " (no clear difference from " + boost::join(not_different, ", ") + ")");
}

} // namespace

long successes(const std::vector<Reached>& runs, std::size_t target) {
    return std::ranges::count_if(runs, [&](const Reached& run) { return !std::isnan(run.evaluations[target]); });
}

double expected_runtime(const std::vector<Reached>& runs, std::size_t target) {
    double sum = 0;
    for (const Reached& run : runs)
        sum += std::isnan(run.evaluations[target]) ? static_cast<double>(run.spent) : run.evaluations[target];
    return sum / static_cast<double>(successes(runs, target));
}

void write_coco_runs(const Contest& contest, const std::filesystem::path& folder) {
    std::map<std::string, std::vector<ga::CocoFunction>> of_variant;
    for (const ProblemResults& results : contest.results) {
        int dimension = 0, function = 0;
        if (std::sscanf(results.problem.name.c_str(), "bbob%d-%d", &dimension, &function) != 2) continue;
        for (std::size_t v = 0; v < results.variants.size(); ++v) {
            ga::CocoFunction one{function, results.problem.genes, {}};
            for (std::size_t s = 0; s < results.runs[v].size(); ++s)
                one.runs.push_back(
                    {instance_of(contest.origin.seed + s), results.runs[v][s].found, results.runs[v][s].spent});
            of_variant[results.variants[v].first].push_back(std::move(one));
        }
    }
    for (const auto& [name, functions] : of_variant) {
        std::string plain = name;
        std::ranges::replace_if(
            plain, [](unsigned char c) { return !std::isalnum(c) && c != '-'; }, '_');
        ga::write_coco(folder / plain, plain, functions);
    }
}

Findings findings_of(const Contest& contest) {
    Findings found{.result = {{"seeds", contest.seeds},
                              {"budget", contest.budget},
                              {"curves", contest.curves},
                              {"surfaces", json::array()}}};
    for (Group& group : groups_of(contest)) {
        add_shares(found, group, contest);
        add_standing(found, group, add_tests(found, group));
        add_problems(found, group, contest);
        const json& standing = found.result["groups"][group.name]["standing"];
        std::string verdict = "best on " + group.name + ": " + standing[0]["variant"].get<std::string>();
        if (group.results[0]->problem.setup) // each surface is a group of its own
            verdict = add_surfaces(found, *group.results[0]);
        found.summary += (found.summary.empty() ? "" : "; ") + verdict;
    }
    found.result["verdict"] = found.summary;
    return found;
}

} // namespace app
