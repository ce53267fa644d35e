#include "domain/design/coarse_to_fine.hpp"

#include "domain/design/pipelines.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Nodes a side of the coarsest grid, and its spacings to the shortest wave, at least.
constexpr Index coarsest_side = 32;
constexpr double coarsest_wave = 1.9;

const char* const on_coarsest =
    "shape 24 | score | best 8 | refine lm 15 | best 4 | refine lm 30 sharpen=10 | best 2";
const char* const on_finer = "score | refine lm 15 sharpen=5 | best 2";

std::string name_of(const Grid& grid) { return std::to_string(grid.nodes) + "x" + std::to_string(grid.rows); }

} // namespace

const char* const on_own_grid = "score | refine lm 12 sharpen=4 | best 1";

ga::Counters sum(const ga::Counters& a, const ga::Counters& b) {
    return {a.asked + b.asked, a.evaluations + b.evaluations, a.remembered + b.remembered,
            a.gradients + b.gradients, a.failures + b.failures};
}

std::vector<DesignSetup> coarser_grids(const DesignSetup& setup) {
    std::vector<DesignSetup> all;
    for (DesignSetup next = setup; all.size() < 2;) {
        Grid& grid = next.model.grid;
        grid.nodes /= 2;
        grid.rows /= 2;
        if (std::min(grid.nodes, grid.rows) < coarsest_side ||
            setup.limits.shortest_wave < coarsest_wave * grid.widest_spacing())
            break;
        all.insert(all.begin(), next);
    }
    return all;
}

CoarseToFine coarse_to_fine(const DesignSetup& setup, const ga::RunOptions& run,
                            const std::vector<ga::Observer<Genome>>& observers) {
    const ga::Stopwatch clock;
    std::vector<DesignSetup> grids = coarser_grids(setup);
    if (grids.empty())
        grids.push_back(setup);
    CoarseToFine result;
    for (const DesignSetup& coarse : grids) {
        const std::string text = result.starts.empty() ? on_coarsest : on_finer;
        ga::RunOptions own = run;
        own.variant += "-" + name_of(coarse.model.grid);
        own.budget.evaluations = std::max(1L, run.budget.evaluations - result.counters.asked);
        own.budget.seconds = std::max(0.0, run.budget.seconds - clock.seconds());
        const auto found = ga::run(design_pipeline(coarse, text), DesignProblem(coarse),
                                   ga::population(result.starts), own, observers);
        result.counters = sum(result.counters, found.counters);
        result.pipeline += text + "\n";
        std::vector<Genome> next;
        for (std::size_t i = 0; i < std::min<std::size_t>(2, found.population.size()); ++i)
            next.push_back(found.population[i].genome);
        if (next.empty() && found.best)
            next.push_back(found.best->genome);
        if (!next.empty())
            result.starts = std::move(next);
    }
    return result;
}

namespace {

/// The middle of what some curves are off by at one point of one target.
double middle(std::initializer_list<const std::vector<Eigen::VectorXd>*> curves, std::size_t t, Index k) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto* misfits : curves)
        if (!misfits->empty()) {
            least = std::min(least, (*misfits)[t][k]);
            most = std::max(most, (*misfits)[t][k]);
        }
    return 0.5 * (least + most);
}

} // namespace

DesignSetup allowing_for(DesignSetup setup, const Judgement& judged) {
    const auto& [own, refined, stepped, both] = judged.misfits;
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        Target& target = setup.targets[t];
        for (Index k = 0; k < target.points(); ++k) {
            const double searched = setup.model.grid.is_area() ? own[t][k] : middle({&own, &stepped}, t, k);
            const double factor =
                1 + (searched - middle({&own, &refined, &stepped, &both, &judged.confirming}, t, k)) /
                        target.weight;
            target.y[k] *= factor;
            if (target.has_band())
                target.lower[k] *= factor, target.upper[k] *= factor;
        }
    }
    return setup;
}

} // namespace rough
