#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"

namespace app {

namespace {

Plot heights_plot(const FractalStudy& study) {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(
        study.whole.nodes(), 0, study.whole.spacing * static_cast<double>(study.whole.nodes() - 1));
    const Unit unit = length_unit(study.whole.heights.cwiseAbs().maxCoeff());
    Plot plot;
    plot.alt = "Heights of the fractal profile, and of its dominant bands, which follow its coarse shape";
    plot.x = {"x (mm)", false, 0, x[x.size() - 1]};
    plot.y = {"Height (" + unit.name + ")"};
    plot.series = {{"whole profile", x, unit.factor * study.whole.heights, Colour::faint, Style::line, 1.2},
                   {"dominant bands", x, unit.factor * study.reduced.heights, Colour::red, Style::line, 2}};
    return plot;
}

Plot response_plot(const std::string& label, const rough::Curve& whole, const rough::Curve& reduced) {
    const Unit unit = pressure_unit(whole.to);
    Plot plot;
    plot.alt = label + " against mean pressure, of the whole profile and of its dominant bands";
    plot.x = {"Mean pressure p (" + unit.name + ")", false, 0, unset};
    plot.y = {label, false, 0, unset};
    plot.series = {shown(whole, unit.factor, {"whole", {}, {}, Colour::text, Style::points, 2}),
                   shown(reduced, unit.factor, {"dominant bands", {}, {}, Colour::red, Style::line, 2})};
    return plot;
}

} // namespace

Figure fractal_figure(const FractalStudy& study) {
    std::size_t kept = 0;
    std::string which;
    for (std::size_t b = 0; b < study.bands.size(); ++b)
        if (study.dominant[b]) {
            ++kept;
            const Unit unit = length_unit(study.bands[b].longest);
            which += (which.empty() ? "" : ", ") + readable(unit.factor * study.bands[b].shortest, 2) + "–" +
                     readable(unit.factor * study.bands[b].longest, 2) + " " + unit.name;
        }
    return {
        "figure-3",
        "Figure 3. A surface that is no MWM series.",
        "The paper's fractured alloy is not public; this is a self-affine profile (H = 0.8) made by spectral "
        "synthesis from a fixed seed. Its chromosomes are octave bands of its cosine components; Algorithm 1 "
        "keeps " +
            std::to_string(kept) + " of " + std::to_string(study.bands.size()) + " (" + which + ").",
        {heights_plot(study),
         response_plot("Stiffness K (MPa/mm)", secant_stiffness(study.whole_response),
                       secant_stiffness(study.reduced_response)),
         response_plot("Contact fraction A", area_against_pressure(study.whole_response),
                       area_against_pressure(study.reduced_response))}};
}

} // namespace app
