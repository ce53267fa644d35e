#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

template <class Value>
Series against_threshold(const PaperRun& run, const std::vector<ThresholdRow>& rows, Series look,
                         Value value) {
    const auto count = static_cast<Eigen::Index>(rows.size());
    look.x.resize(count);
    look.y.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const ThresholdRow& row = rows[static_cast<std::size_t>(i)];
        look.x[i] = row.p_bar / run.max_pressure;
        look.y[i] = value(row);
    }
    return look;
}

Series look(const Algorithm& algorithm, const std::string& label, bool faint = false) {
    return {label,
            {},
            {},
            algorithm.colour,
            faint ? Style::line : Style::line_points,
            faint ? 1. : 2.,
            faint ? Dash::dotted : Dash::solid};
}

Plot threshold_plot(const std::string& part, const std::string& label, const TargetRun& target) {
    Plot plot;
    plot.title = part + ", " + target.title + " target";
    plot.x = {"Threshold p̄ / pₘₐₓ"};
    plot.y = {label};
    return plot;
}

/// A round per cent above every share, so that no share at all still has an axis.
double highest_share(const TargetRun& target) {
    double most = 0;
    for (const ThresholdRow& row : target.thresholds)
        most = std::max(most, row.share_above);
    return 10 * (std::floor(10 * most) + 1);
}

} // namespace

Figure thresholds_figure(const PaperRun& run) {
    Figure figure{
        "figure-8",
        "Figure 8. The threshold's part.",
        Html::raw("A: best similarity against the threshold (thin: the best child before GCMMA). B: how many "
                  "children there are, |U<sub>3</sub>| = |U<sub>1</sub>| |U<sub>2</sub>|, and which share of "
                  "the distinct ones has s above 0.95. Where U<sub>1</sub> or U<sub>2</sub> held fewer than "
                  "three genomes above 0.95 the three best were taken."),
        {}};
    for (const TargetRun& target : run.targets) {
        Plot best = threshold_plot("A", "Best similarity s", target);
        Plot size = threshold_plot("B", "Children |U₃|", target);
        Plot share = threshold_plot("B", "Share above 0.95 (%)", target);
        best.alt = "Best similarity of GCO and CCO against the threshold, " + target.title + " target";
        size.alt = "Number of children against the threshold, " + target.title + " target";
        share.alt = "Share of children above 0.95 against the threshold, " + target.title + " target";
        share.y.from = 0;
        share.y.to = highest_share(target);
        size.y.from = 0;
        for (const Algorithm& algorithm : algorithms) {
            const auto rows = thresholds_of(target, algorithm.name);
            if (rows.empty())
                continue;
            best.series.push_back(against_threshold(run, rows, look(algorithm, algorithm.title),
                                                    [](const ThresholdRow& row) { return row.similarity; }));
            best.series.push_back(against_threshold(run, rows, look(algorithm, "", true),
                                                    [](const ThresholdRow& row) { return row.best_child; }));
            size.series.push_back(
                against_threshold(run, rows, look(algorithm, algorithm.title), [](const ThresholdRow& row) {
                    return static_cast<double>(row.u1 * row.u2);
                }));
            share.series.push_back(
                against_threshold(run, rows, look(algorithm, algorithm.title),
                                  [](const ThresholdRow& row) { return 100 * row.share_above; }));
        }
        figure.panels.insert(figure.panels.end(), {best, size, share});
    }
    return figure;
}

} // namespace app
