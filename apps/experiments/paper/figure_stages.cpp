#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"

namespace app {

namespace {

constexpr std::array<Colour, 3> ranks = {Colour::blue, Colour::red, Colour::green};

Plot stages_plot(const TargetRun& target, const Algorithm& algorithm, double from) {
    Plot plot;
    plot.alt = std::string("Similarity of ") + algorithm.title + "'s three candidates with the " +
               target.title + " target after each refinement";
    plot.title = std::string(algorithm.title) + ", " + target.title + " target";
    plot.x = {"", false, -0.2, 2.2, {{0, "(0)"}, {1, "(1)"}, {2, "(2)"}}};
    plot.y = {"Similarity s", false, from, 1};
    plot.height = 340;
    const VariantRun* variant = find_variant(target, algorithm.name);
    if (!variant)
        return plot;
    std::size_t rank = 0;
    for (const Refinement& candidate : refinements(*variant)) {
        plot.series.push_back({"no. " + std::to_string(candidate.id), Eigen::Vector3d(0, 1, 2),
                               Eigen::Map<const Eigen::Vector3d>(candidate.similarity.data()),
                               ranks[rank % ranks.size()], Style::line_points, 2});
        ++rank;
    }
    return plot;
}

/// A round number under every similarity that is shown, so that all panels share one scale.
double lowest(const PaperRun& run) {
    double least = 0.95;
    for (const TargetRun& target : run.targets)
        for (const Algorithm& algorithm : algorithms)
            if (const VariantRun* variant = find_variant(target, algorithm.name))
                for (const Refinement& candidate : refinements(*variant))
                    for (double s : candidate.similarity)
                        least = std::fmin(least, s);
    return std::floor(20 * least) / 20;
}

} // namespace

Figure stages_figure(const PaperRun& run) {
    Figure figure{"figure-7",
                  "Figure 7. What refinement adds.",
                  "Similarity of the three best candidates, by their numbers, before GCMMA (0), after it (1) "
                  "and after the left-out "
                  "chromosomes' turn (2); CCO has no second turn and copies (1). All panels on one scale.",
                  {}};
    const double from = lowest(run);
    for (const TargetRun& target : run.targets)
        for (const Algorithm& algorithm : algorithms)
            figure.panels.push_back(stages_plot(target, algorithm, from));
    return figure;
}

} // namespace app
