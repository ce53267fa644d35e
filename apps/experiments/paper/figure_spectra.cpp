#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/profile/spectrum.hpp"

#include <numbers>

namespace app {

namespace {

Axis wave_axis(const PaperRun& run) {
    const double longest = 2 * std::numbers::pi / run.model.grid.length;
    return {"Wave number q (rad/mm)", true, 0.8 * longest, std::numbers::pi / run.model.grid.spacing()};
}

Plot lines_plot(const PaperRun& run, const TargetRun& target) {
    Plot plot;
    plot.alt = "Power of each cosine of the answers against wave number, " + target.title + " target";
    plot.title = titled(target);
    plot.x = wave_axis(run);
    plot.x.to = unset;
    plot.y = {"Power of a wave (mm²)", true};
    for (const auto& [variant, title, colour, dash] : shown_answers(target)) {
        const auto lines = discrete_spectrum(variant->answer.genome);
        Series series{title, {}, {}, colour, Style::points, 2.2};
        series.x.resize(static_cast<Eigen::Index>(lines.size()));
        series.y.resize(static_cast<Eigen::Index>(lines.size()));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            series.x[static_cast<Eigen::Index>(i)] = lines[i].wave_number;
            series.y[static_cast<Eigen::Index>(i)] = lines[i].power;
        }
        plot.series.push_back(series);
    }
    return plot;
}

Plot density_plot(const PaperRun& run, const TargetRun& target) {
    Plot plot;
    plot.alt = "Power spectral density of the answers against wave number, " + target.title + " target";
    plot.title = titled(target);
    plot.x = wave_axis(run);
    plot.y = {"Density (mm³)", true};
    for (const auto& [variant, title, colour, dash] : shown_answers(target)) {
        const auto spectrum = continuous_spectrum(sample(variant->answer.genome, run.model.grid));
        plot.series.push_back(
            {title, spectrum.wave_number, spectrum.density, colour, Style::line, 1.5, dash});
    }
    return plot;
}

} // namespace

Figure spectra_figure(const PaperRun& run) {
    Figure figure{"figure-11",
                  "Figure 11. What the surfaces are made of.",
                  "Discrete spectrum (the power of each cosine, exact) and continuous power spectral density "
                  "(FFT of the sampled heights under a Hann window) of the answers.",
                  {}};
    for (const TargetRun& target : run.targets) {
        figure.panels.push_back(lines_plot(run, target));
        figure.panels.push_back(density_plot(run, target));
    }
    return figure;
}

} // namespace app
