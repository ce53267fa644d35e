#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"

#include <algorithm>
#include <array>

namespace app {

namespace {

constexpr std::array<Colour, 3> colours = {Colour::blue, Colour::red, Colour::green};

/// The best similarity known so far after each stage, against what was spent until then.
Series convergence_of(const VariantRun& variant, Colour colour) {
    std::vector<double> spent, best;
    for (const StageRecord& stage : variant.stages) {
        double known = best.empty() ? -INFINITY : best.back();
        for (const Candidate& one : stage.candidates)
            known = std::fmax(known, one.similarity);
        if (!std::isfinite(known))
            continue;
        spent.push_back(static_cast<double>(stage.spent));
        best.push_back(known);
    }
    const auto count = static_cast<Eigen::Index>(spent.size());
    return {shown_name(variant.name),
            Eigen::Map<Eigen::VectorXd>(spent.data(), count),
            Eigen::Map<Eigen::VectorXd>(best.data(), count),
            colour,
            Style::line_points,
            2};
}

} // namespace

Figure convergence_figure(const PaperRun& run) {
    Figure figure{
        "convergence",
        "How the runs converge.",
        "Best similarity known after each stage against the contact curves and gradients spent until "
        "then. The first point is the database's or the children's best; the rest is refinement.",
        {}};
    for (const TargetRun& target : run.targets)
        for (std::size_t first = 0; first < target.variants.size(); first += 3) {
            Plot plot;
            plot.alt = "Best similarity against curves and gradients spent, " + target.title + " target";
            plot.title = titled(target);
            plot.x = {"Contact curves and gradients", false};
            plot.y = {"Best similarity", false};
            for (std::size_t v = first; v < std::min(first + 3, target.variants.size()); ++v)
                plot.series.push_back(convergence_of(target.variants[v], colours[v - first]));
            figure.panels.push_back(std::move(plot));
        }
    return figure;
}

} // namespace app
