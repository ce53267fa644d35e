#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"

namespace app {

namespace {

Series target_points(const rough::Target& target, double factor) {
    return {"target, " + target.name, factor * target.x, target.y, Colour::text, Style::points, 2};
}

Axis pressure_axis(const PaperRun& run) {
    const Unit unit = pressure_unit(run.max_pressure);
    return {"Mean pressure p (" + unit.name + ")", false, 0, unit.factor * run.max_pressure};
}

constexpr const char* stiffness_label = "Stiffness K (MPa/mm)";

Plot parts_plot(const PaperRun& run, const TargetRun& target) {
    const Unit unit = pressure_unit(run.max_pressure);
    Plot plot;
    plot.alt = "Two database curves and the " + target.title +
               " target: one meets it at low pressures only, the other at high ones";
    plot.title = titled(target);
    plot.x = pressure_axis(run);
    plot.y = {stiffness_label, false, 0, unset};
    plot.guides = {{unit.factor * target.p_bar}};
    for (const bool low : {true, false})
        if (const auto part = best_in_part(target, low))
            plot.series.push_back(shown(secant_stiffness(run.database[part->genome].response), unit.factor,
                                        {std::string("genome ") + std::to_string(part->genome) +
                                             ": s = " + readable(low ? part->scores.low : part->scores.high) +
                                             (low ? " below" : " above"),
                                         {},
                                         {},
                                         low ? Colour::blue : Colour::red,
                                         Style::line,
                                         2,
                                         low ? Dash::solid : Dash::dashed}));
    plot.series.push_back(target_points(target.target, unit.factor));
    plot.series.back().label = "target";
    return plot;
}

std::string part_words(const TargetRun& target) {
    std::string words = titled(target) + ": ";
    for (const bool low : {true, false})
        if (const auto part = best_in_part(target, low))
            words += (low ? "genome " : "; genome ") + std::to_string(part->genome) +
                     " has s = " + readable(part->scores.all) + " over all pressures and " +
                     readable(low ? part->scores.low : part->scores.high) + (low ? " below " : " above ") +
                     "<i>p̄</i>";
    return words + ". ";
}

} // namespace

Figure parts_figure(const PaperRun& run) {
    Figure figure{"figure-4", "Figure 4. Good in one part.", "", {}};
    for (const TargetRun& target : run.targets) {
        figure.panels.push_back(parts_plot(run, target));
        figure.caption += Html::raw(part_words(target));
    }
    figure.caption += Html::raw(
        "The dashed line is the threshold <i>p̄</i>. Genomes with s ≤ 0.95 over all pressures, the best over "
        "each part. The cross-over adds the profiles of two such parents.");
    return figure;
}

Figure pairs_figure(const PaperRun& run) {
    const auto pairs = rough::sobol_pairs(run.layout);
    Series points{"",
                  Eigen::VectorXd(static_cast<Eigen::Index>(pairs.size())),
                  Eigen::VectorXd(static_cast<Eigen::Index>(pairs.size())),
                  Colour::blue,
                  Style::points,
                  3};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        points.x[static_cast<Eigen::Index>(i)] = pairs[i].first;
        points.y[static_cast<Eigen::Index>(i)] = pairs[i].second;
    }
    Plot plot;
    plot.alt = "Points spread evenly over the rectangle of Hurst exponents and frequency ratios";
    plot.x = {"Hurst exponent H", false, run.layout.H_from, run.layout.H_to};
    plot.y = {"Frequency ratio γ", false, run.layout.gamma_from, run.layout.gamma_to};
    plot.series = {points};
    return {"figure-5",
            "Figure 5. The database's pairs.",
            std::to_string(pairs.size()) +
                " Sobol points (H, γ), the first point of the sequence skipped; each pair has " +
                std::to_string(run.layout.phase_columns) + " sets of phases, " +
                std::to_string(run.database.size()) + " genomes in all.",
            {plot}};
}

Figure database_figure(const PaperRun& run) {
    const Unit unit = pressure_unit(run.max_pressure);
    std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> curves;
    for (const Answered& member : run.database) {
        const rough::Curve K = secant_stiffness(member.response);
        curves.emplace_back(unit.factor * K.x, K.y);
    }
    Plot plot;
    plot.alt = "Stiffness curves of all database genomes, rising with pressure, and the targets among them";
    plot.x = pressure_axis(run);
    plot.y = {stiffness_label, false, 0, unset};
    plot.series = {bundle(curves, {"the database", {}, {}, Colour::faint, Style::line, 0.6})};
    static constexpr std::array<Colour, 2> colours = {Colour::blue, Colour::red};
    for (std::size_t t = 0; t < run.targets.size(); ++t) {
        plot.series.push_back(target_points(run.targets[t].target, unit.factor));
        plot.series.back().label = run.targets[t].title + " target";
        plot.series.back().colour = colours[t % 2];
        plot.series.back().style = Style::line_points;
    }
    return {
        "figure-6",
        "Figure 6. The database and the targets.",
        Html::raw("K(p) of the " + std::to_string(run.database.size()) +
                  " genomes, rescaled by Eq. 11 to p<sub>max</sub>, and the targets. A stiffness curve never "
                  "falls and never "
                  "exceeds that of full contact."),
        {plot}};
}

} // namespace app
