#include "apps/experiments/paper/chromosome_example.hpp"
#include "apps/experiments/paper/figures.hpp"

namespace app {

namespace {

Plot chromosome_plot(const ChromosomeExample& example) {
    std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> ridges;
    for (const Eigen::VectorXd& heights : example.ridges)
        ridges.emplace_back(1e3 * example.x, 1e3 * heights);
    Plot plot;
    plot.alt = "Eight cosines of one wave length and their sum, one cosine of the same length, for n = " +
               std::to_string(example.n);
    plot.x = {"x (µm)", false, 0, 1e3 * example.x[example.x.size() - 1]};
    plot.y = {"Height of n = " + std::to_string(example.n) + " (µm)"};
    plot.series = {bundle(ridges, {"its 8 ridges", {}, {}, Colour::faint, Style::line, 1}),
                   {"chromosome", 1e3 * example.x, 1e3 * example.sum, Colour::blue, Style::line, 2.5}};
    return plot;
}

} // namespace

Figure chromosomes_figure(std::uint64_t seed) {
    Figure figure{
        "figure-1",
        "Figure 1. A chromosome is one wave.",
        Html::raw("Two chromosomes of one series (M = 8, γ = 1.5, L = λ<sub>1</sub> = 100 µm) and the eight "
                  "cosines each is the sum of. However many ridges, the sum is a single cosine of the same "
                  "wave length: 100 µm for n = 1, 66.7 µm for n = 2."),
        {}};
    for (int n : {1, 2})
        figure.panels.push_back(chromosome_plot(chromosome_example(n, seed)));
    return figure;
}

} // namespace app
