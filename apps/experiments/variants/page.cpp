#include "apps/report/page.hpp"

#include "apps/experiments/variants/run.hpp"
#include "apps/report/map_plot.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

/// How far the best is from the target in the median, against what was spent.
template <class MedianAt>
Plot shortfall_plot(const RaceTarget& target, const std::string& axis, double from, double to,
                    MedianAt median_at) {
    Plot plot;
    plot.alt =
        "1 less the best similarity so far of every way, in the median over the seeds, against " + axis;
    plot.x = {axis, true, from, to};
    plot.y = {"1 - similarity", true};
    plot.height = 380;
    constexpr int points = 60;
    for (std::size_t i = 0; i < target.variants.size(); ++i) {
        const RaceVariant& variant = target.variants[i];
        if (variant.runs.empty())
            continue;
        Eigen::VectorXd x(points), y(points);
        for (int k = 0; k < points; ++k) {
            x[k] = from * std::pow(to / from, k / (points - 1.0));
            const double similarity = median_at(variant, x[k]);
            y[k] = similarity > -1 ? std::max(1e-5, 1 - similarity) : unset;
        }
        plot.series.push_back({variant.name, x, y, line_colour(i), Style::line, 2, line_dash(i)});
    }
    return plot;
}

bool is_2d(const RaceTarget& target) { return target.setup.model.grid.is_2d(); }

/// What the genes mean on the target's grid.
std::string on_grid(const RaceTarget& target) {
    const rough::Model& model = target.setup.model;
    const rough::Grid& grid = model.grid;
    const bool free = model.body.kernel == rough::Kernel::free;
    if (is_2d(target))
        return "An area of " + std::to_string(grid.nodes) + " x " + std::to_string(grid.rows) + " nodes on " +
               brief(grid.length, 6) + " x " + brief(grid.width, 6) + " mm. The " +
               std::to_string(target.setup.ridges) +
               " ridges of a chromosome are as many directions (Ausloos & Berman 1985)" +
               (free ? "; displacements are measured to infinity, there is no datum." : ".");
    return "A profile of " + std::to_string(grid.nodes) + " nodes on " + brief(grid.length, 6) +
           " mm, drawn out along endless ridges. The ridges of a chromosome are one cosine" +
           (free ? "; displacements are measured to the datum, d = " + brief(model.body.datum, 6) + " mm."
                 : std::string("."));
}

/// The area that a way's median run found, and where it touches at the end of the load.
Figure area_figure(const RaceTarget& target, const RaceVariant& best, std::size_t number) {
    const rough::Model& model = target.setup.model;
    const RaceRun& run = best.median_run();
    const rough::Profile surface = sample(run.run.answer.genome, model.grid);
    return {"best-" + std::to_string(number),
            "What " + best.name + " found.",
            "The surface of the way that ended nearest, its median run; and the pressure at the last load.",
            {heights_plot(model.grid, surface.heights, "Heights"),
             pressure_plot(model, surface, run.last_displacement, "Where it touches at the last load")}};
}

/// The ways on areas and on profiles beside each other.
void add_grids(Page& page, const Race& race) {
    page.section("Areas beside profiles");
    page.prose("The same ways for the same targets, from the same seeds. The same genes answer a load "
               "differently: on an area spots are surrounded by gaps, on a profile they are endless strips.");
    Table table{"", {"Way"}, {}, {false}};
    for (const RaceTarget& target : race.targets)
        for (const char* what : {", similarity at worst", ", seconds"}) {
            table.header.push_back(target.setup.targets[0].name +
                                   (is_2d(target) ? ", area" : ", profile") + what);
            table.numeric.push_back(true);
        }
    for (std::size_t i = 0; i < race.targets.front().variants.size(); ++i) {
        std::vector<Html> row{race.targets.front().variants[i].name};
        for (const RaceTarget& target : race.targets) {
            const bool ran = i < target.variants.size() && !target.variants[i].runs.empty();
            if (!ran) {
                row.insert(row.end(), 2, "–");
                continue;
            }
            const VariantRun& run = target.variants[i].median_run().run;
            row.push_back(readable(target.variants[i].median_lowest(), 4));
            row.push_back(readable(run.seconds));
        }
        table.rows.push_back(std::move(row));
    }
    page.table(table);
    for (const RaceTarget& target : race.targets)
        for (const RaceVariant& variant : target.variants)
            if (!variant.runs.empty())
                for (const std::string& note : variant.median_run().run.notes)
                    page.prose(target.setup.targets[0].name + ", " + variant.name + ": " + note + ".");
}

void add_target(Page& page, const Race& race, const RaceTarget& target, std::size_t number) {
    page.section("Target " + target.setup.targets[0].name);
    if (std::any_of(race.targets.begin(), race.targets.end(), is_2d))
        page.prose(on_grid(target));
    double longest = 0.1;
    for (const auto& variant : target.variants)
        for (const auto& run : variant.runs)
            longest = std::max(longest, run.run.seconds);
    page.figure(
        {"race-" + std::to_string(number),
         "Figure " + std::to_string(number) + ". Who is how near, when.",
         "Best similarity so far on the search's grid, medians over the seeds; the lower the nearer.",
         {shortfall_plot(target, "Curves and gradients", 10, static_cast<double>(race.budget),
                         [](const RaceVariant& v, double x) { return v.median_at(static_cast<long>(x)); }),
          shortfall_plot(target, "Seconds", 0.02, longest,
                         [](const RaceVariant& v, double x) { return v.median_at_seconds(x); })}});
    Table table{"Where they ended",
                {"Way", "Similarity, worse of both grids (median)", "Seconds", "Curves", "Gradients",
                 "Children of two", "Better than both parents"},
                {},
                {false, true, true, true, true, true, true}};
    std::vector<const RaceVariant*> order;
    for (const auto& variant : target.variants)
        if (!variant.runs.empty())
            order.push_back(&variant);
    std::stable_sort(order.begin(), order.end(), [](const RaceVariant* a, const RaceVariant* b) {
        return a->median_lowest() > b->median_lowest();
    });
    for (const RaceVariant* variant : order) {
        const VariantRun& run = variant->median_run().run;
        long crossed = 0, better = 0;
        for (const auto& each : variant->runs)
            crossed += each.crossed, better += each.better;
        table.rows.push_back(
            {variant->name, readable(variant->median_lowest(), 4), readable(run.seconds),
             std::to_string(run.curves), std::to_string(run.gradients), std::to_string(crossed),
             crossed > 0 ? percent(static_cast<double>(better) / static_cast<double>(crossed)) : "–"});
    }
    page.table(table);
    if (is_2d(target) && !order.empty())
        page.figure(area_figure(target, *order.front(), number));
}

} // namespace

std::string race_page(const Race& race) {
    Page page("What each idea is worth",
              "Ways to search for a surface, on the same targets, with the same budget of " +
                  std::to_string(race.budget) + " contact curves and gradients.");
    std::size_t number = 0;
    for (const RaceTarget& target : race.targets)
        add_target(page, race, target, ++number);
    if (std::any_of(race.targets.begin(), race.targets.end(), is_2d) &&
        !std::all_of(race.targets.begin(), race.targets.end(), is_2d))
        add_grids(page, race);
    page.section("The ways");
    for (const RaceVariant& variant : race.targets.front().variants)
        if (!variant.runs.empty())
            page.code(variant.name + " = " + variant.runs.front().run.pipeline);
    page.code(race.origin.command);
    return page.html();
}

} // namespace app
