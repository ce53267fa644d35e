#include "apps/report/page.hpp"

#include "apps/experiments/accuracy/run.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace app {

namespace {

/// Medians over the random surfaces, by accuracy.
Series median_line(const AccuracyRun& run, const std::string& label, Colour colour, Dash dash,
                   const std::function<bool(const SavingRow&)>& of,
                   const std::function<double(const SavingRow&)>& value) {
    std::map<double, std::vector<double>> by_accuracy;
    for (const SavingRow& row : run.savings)
        if (of(row))
            by_accuracy[row.accuracy].push_back(value(row));
    const auto count = static_cast<Eigen::Index>(by_accuracy.size());
    Series line{label, Eigen::VectorXd(count), Eigen::VectorXd(count), colour, Style::line_points, 2, dash};
    Eigen::Index i = 0;
    for (const auto& [accuracy, values] : by_accuracy) {
        line.x[i] = accuracy;
        line.y[i++] = rough::median(values);
    }
    return line;
}

Plot savings_plot(const AccuracyRun& run, const std::string& kernel, const std::string& what,
                  const std::function<double(const SavingRow&)>& value) {
    Plot plot;
    plot.title = kernel == "free" ? "Half-plane (free)" : "Strip";
    plot.alt = what + " against the accuracy asked for, medians over random surfaces, " + kernel;
    plot.x = {"Accuracy asked for", true};
    plot.y = {what, true};
    plot.height = 340;
    for (const std::string surface : {"smooth", "rough"})
        for (const std::string load : {"light", "full"})
            plot.series.push_back(median_line(
                run, surface + ", " + load + " load", surface == "smooth" ? Colour::blue : Colour::orange,
                load == "light" ? Dash::dashed : Dash::solid,
                [&](const SavingRow& row) {
                    return row.surface == surface && row.load == load && row.kernel == kernel;
                },
                value));
    return plot;
}

void add_savings(Page& page, const AccuracyRun& run) {
    page.section("What accuracy costs");
    const auto milliseconds = [](const SavingRow& row) { return 1e3 * row.seconds; };
    const auto saving = [](const SavingRow& row) { return row.resolved_seconds / row.seconds; };
    page.figure({"figure-1",
                 "Figure 1. Cost of a curve within an accuracy.",
                 "Processor time of a curve on one core; the resolved curve is beyond the left end.",
                 {savings_plot(run, "free", "Milliseconds", milliseconds),
                  savings_plot(run, "strip", "Milliseconds", milliseconds)}});
    page.figure({"figure-2",
                 "Figure 2. Saving.",
                 "Time of the resolved curve over that of the curve within the accuracy; above 1 it pays.",
                 {savings_plot(run, "free", "Resolved time over time", saving),
                  savings_plot(run, "strip", "Resolved time over time", saving)}});
    std::map<double, std::vector<const SavingRow*>, std::greater<>> by_accuracy;
    for (const SavingRow& row : run.savings)
        by_accuracy[row.accuracy].push_back(&row);
    Table table{"Is the error what it is said to be?",
                {"Accuracy", "Scenes", "Estimate covers the true error", "Within the accuracy",
                 "Worst error over accuracy", "Median saving"},
                {},
                {true, true, true, true, true, true}};
    for (const auto& [accuracy, rows] : by_accuracy) {
        double covered = 0, within = 0, worst = 0;
        std::vector<double> savings;
        for (const SavingRow* row : rows) {
            covered += row->covered();
            within += row->true_error <= accuracy;
            worst = std::max(worst, row->true_error / accuracy);
            savings.push_back(saving(*row));
        }
        const auto count = static_cast<double>(rows.size());
        table.rows.push_back({readable(accuracy), std::to_string(rows.size()), percent(covered / count),
                              percent(within / count), readable(worst, 3),
                              readable(rough::median(savings), 3)});
    }
    page.table(table);
}

void add_budget(Page& page, const AccuracyRun& run) {
    if (run.design.name.empty())
        return;
    page.section("The error budget of a designed surface");
    page.prose("The surface was designed for the target " + run.setup.targets.front().name +
               "; each row says by how much its K(p) moves at the target's points, relative and at most, "
               "when one thing is changed and Eq. 11 applied anew.");
    Table table{"", {"Kind", "Source", "Size"}, {}, {false, false, true}};
    Plot plot;
    plot.alt = "Sizes of all sources of error of a designed surface";
    plot.x = {"", false, 0.3, static_cast<double>(run.budget.size()) + 0.7};
    plot.y = {"Relative size", true};
    plot.height = 300;
    plot.key = "off";
    Eigen::VectorXd x(static_cast<Eigen::Index>(run.budget.size())), y(x.size());
    for (std::size_t i = 0; i < run.budget.size(); ++i) {
        const rough::ErrorSource& row = run.budget[i];
        table.rows.push_back({std::to_string(i + 1) + ". " + row.kind, row.source, percent(row.size)});
        x[static_cast<Eigen::Index>(i)] = static_cast<double>(i + 1);
        y[static_cast<Eigen::Index>(i)] = std::max(row.size, 1e-16);
        plot.x.ticks.emplace_back(static_cast<double>(i + 1), std::to_string(i + 1));
    }
    plot.series.push_back({"", x, y, Colour::blue, Style::points, 4});
    page.figure({"figure-3",
                 "Figure 3. Where a designed surface's errors come from.",
                 "The numbers are those of the table below.",
                 {plot}});
    page.table(table);
}

} // namespace

std::string accuracy_page(const AccuracyRun& run) {
    Page page("No more than a scene needs",
              "What accuracy costs, and what is gained by modelling no more than an answer needs.");
    add_savings(page, run);
    add_budget(page, run);
    page.code(run.origin.command);
    return page.html();
}

} // namespace app
