#include "apps/report/page.hpp"

#include "apps/experiments/compare/contest.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr double significant = 0.05;

Eigen::VectorXd vector_of(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Plot share_plot(const GroupResult& group) {
    const Contestants& variants = group.bouts.front()->variants;
    Plot plot;
    plot.alt = "Share of targets that each variant has reached against evaluations a gene, with intervals.";
    plot.x = {group.name == "roughness" ? "Curves and gradients" : "Evaluations / genes", true, 1,
              std::max(2.0, group.evaluations.back())};
    plot.y = {"Share of targets reached", false, 0, 1};
    plot.height = 380;
    const Eigen::VectorXd x = vector_of(group.evaluations);
    for (std::size_t v = 0; v < variants.size(); ++v) {
        const RuntimeShare& share = group.shares[v];
        plot.series.push_back(
            {variants[v].first, x, vector_of(share.share), line_colour(v), Style::line, 2, line_dash(v)});
        plot.series.push_back(bundle({{x, vector_of(share.lower)}, {x, vector_of(share.upper)}},
                                     {"", {}, {}, line_colour(v), Style::line, 0.7, Dash::dotted}));
    }
    return plot;
}

/// Whether a variant is better than another over the group, or on a problem, after the correction.
bool beats(const GroupResult& group, const std::string& problem, std::size_t better, std::size_t worse) {
    return std::any_of(group.duels.begin(), group.duels.end(), [&](const Duel& duel) {
        return duel.problem == problem && duel.corrected <= significant &&
               ((duel.first == better && duel.second == worse && duel.difference > 0) ||
                (duel.first == worse && duel.second == better && duel.difference < 0));
    });
}

Table standing(const GroupResult& group) {
    const Contestants& variants = group.bouts.front()->variants;
    const bool alone = group.bouts.size() == 1;
    Table table{
        "Who is ahead: mean ranks and areas; Friedman's test p = " + readable(group.ranks.p),
        {"Variant", "Mean rank", "Area", "Better than", "Problems on which it is better than, all told"},
        {},
        {false, true, true, false, true}};
    const auto order = ga::in_order(variants.size(), [&](std::size_t a, std::size_t b) {
        return group.ranks.mean_ranks[a] < group.ranks.mean_ranks[b];
    });
    for (const std::size_t v : order) {
        std::string better;
        long wins = 0;
        for (const std::size_t other : order) {
            if (beats(group, alone ? group.bouts[0]->problem.name : "", v, other))
                better += (better.empty() ? "" : ", ") + variants[other].first;
            for (const Bout* bout : group.bouts)
                wins += beats(group, bout->problem.name, v, other);
        }
        table.rows.push_back({variants[v].first, readable(group.ranks.mean_ranks[v]),
                              readable(mean_area(group, v)), better.empty() ? "–" : better,
                              std::to_string(wins)});
    }
    return table;
}

Table each_problem(const GroupResult& group) {
    const Contestants& variants = group.bouts.front()->variants;
    Table table{
        "Precision at the end, median [interval], and expected evaluations to the last target (successes)",
        {"Problem"},
        {},
        {false}};
    for (const auto& [name, text] : variants) {
        table.header.push_back(name);
        table.numeric.push_back(true);
    }
    for (const Bout* bout : group.bouts) {
        std::vector<Html> row{bout->problem.name};
        for (const std::vector<Reached>& runs : bout->runs) {
            const std::vector<double> precision = rough::column(runs, &Reached::precision);
            const rough::Interval interval = rough::median_interval(precision);
            const std::size_t last = bout->problem.targets.size() - 1;
            const long reached = successes(runs, last);
            row.push_back(readable(rough::median(precision), 2) + " [" + readable(interval.lower, 2) + ", " +
                          readable(interval.upper, 2) + "]" +
                          (reached > 0 ? "; " + readable(expected_runtime(runs, last)) + " (" +
                                             std::to_string(reached) + ")"
                                       : ""));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

std::string contest_page(const Contest& contest, const std::vector<GroupResult>& groups) {
    Page page("Variants compared",
              "Every variant on every problem, " + std::to_string(contest.seeds) + " runs each of " +
                  contest.budget +
                  " evaluations (D: genes). A pipeline that ends early begins anew, but on roughness.");
    std::size_t number = 0;
    for (const GroupResult& group : groups) {
        page.section(group.name);
        page.figure(
            {"shares-" + std::to_string(++number),
             "Figure " + std::to_string(number) + ". When targets are reached.",
             "Share of all pairs of run and target (51 precisions a problem) that were reached with so many "
             "evaluations; dotted: where 95 % of redrawn seeds lie. Higher and further left is better.",
             {share_plot(group)}});
        page.table(standing(group));
        page.table(each_problem(group));
    }
    page.prose(
        "Area is the mean height of a run's curve in the picture. Over a group's problems areas are compared "
        "by Friedman's test and, in pairs, by signed ranks; on each problem by rank sums. Pairs are "
        "corrected "
        "by Holm; better means p at most 0.05 then. Intervals of medians are order statistics, of 95 % from "
        "6 seeds on.");
    page.section("The variants");
    std::vector<std::string> told;
    for (const GroupResult& group : groups)
        for (const auto& [name, text] : group.bouts.front()->variants)
            if (const std::string line = name + " = " + text;
                std::find(told.begin(), told.end(), line) == told.end()) {
                page.code(line);
                told.push_back(line);
            }
    page.code(contest.origin.command);
    return page.html();
}

} // namespace app
