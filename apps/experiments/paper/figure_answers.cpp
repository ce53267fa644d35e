#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"
#include "domain/mwm/sampling.hpp"

namespace app {

namespace {

template <class CurveOf>
Plot response_plot(const PaperRun& run, const TargetRun& target, const std::string& label, CurveOf curve_of) {
    const Unit unit = pressure_unit(run.max_pressure);
    Plot plot;
    plot.alt = label + " of the answers against mean pressure, " + target.title + " target";
    plot.title = titled(target);
    plot.x = {"Mean pressure p (" + unit.name + ")", false, 0, unit.factor * run.max_pressure};
    plot.y = {label, false, 0, unset};
    for (const auto& [variant, title, colour, dash] : shown_answers(target))
        plot.series.push_back(shown(curve_of(variant->answer.response), unit.factor,
                                    {title, {}, {}, colour, Style::line, 2, dash}));
    return plot;
}

} // namespace

Figure answers_figure(const PaperRun& run) {
    Figure figure{"figure-9",
                  "Figure 9. What the answers do.",
                  "Stiffness and contact fraction of the answers; points are the target, "
                  "which asks for "
                  "stiffness alone.",
                  {}};
    for (const TargetRun& target : run.targets) {
        Plot stiffness = response_plot(run, target, "Stiffness K (MPa/mm)", rough::secant_stiffness);
        stiffness.series.push_back({"target", pressure_unit(run.max_pressure).factor * target.target.x,
                                    target.target.y, Colour::text, Style::points, 2});
        figure.panels.push_back(stiffness);
        figure.panels.push_back(
            response_plot(run, target, "Contact fraction A", rough::area_against_pressure));
    }
    return figure;
}

Figure profiles_figure(const PaperRun& run) {
    Figure figure{"figure-10",
                  "Figure 10. The surfaces.",
                  "Heights of the answers, each about its own mean, at the amplitude of Eq. 11.",
                  {}};
    for (const TargetRun& target : run.targets) {
        std::vector<std::pair<ShownAnswer, Eigen::VectorXd>> profiles;
        double largest = 0;
        for (const ShownAnswer& answer : shown_answers(target)) {
            Eigen::VectorXd heights = sample(answer.variant->answer.genome, run.model.grid).heights;
            heights.array() -= heights.mean();
            largest = std::max(largest, heights.cwiseAbs().maxCoeff());
            profiles.emplace_back(answer, heights);
        }
        const Unit unit = length_unit(largest);
        Plot plot;
        plot.alt = "Heights of the answers along the profile, " + target.title + " target";
        plot.title = titled(target);
        plot.x = {"x (mm)", false, 0, run.model.grid.length};
        plot.y = {"Height (" + unit.name + ")"};
        for (const auto& [answer, heights] : profiles)
            plot.series.push_back(
                {answer.title,
                 Eigen::VectorXd::LinSpaced(
                     heights.size(), 0, run.model.grid.spacing() * static_cast<double>(heights.size() - 1)),
                 unit.factor * heights, answer.colour, Style::line, 1.5});
        figure.panels.push_back(plot);
        if (profiles.size() > 1 && profiles[0].first.title == "SOG" && profiles[1].first.title == "GCO" &&
            (profiles[0].second - profiles[1].second).cwiseAbs().maxCoeff() < 1e-9 * largest)
            figure.caption +=
                " On the " + target.title + " target GCO's surface is SOG's: its parents are one genome.";
    }
    return figure;
}

} // namespace app
