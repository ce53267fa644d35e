#include "domain/design/starts.hpp"

#include "domain/design/advance.hpp"
#include "domain/design/defaults.hpp"
#include "domain/design/shape_to_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace rough {

namespace {

/// Where nodes touch first: peaks of a field over the profile, highest first. One asperity in half of the
/// cases, else up to eight, of equal height and like width.
std::vector<int> drawn_order(Index nodes, bool wraps, ga::Stream& random) {
    const std::size_t peaks = random.chance(0.5) ? 1 : 2 + random.below(7);
    struct Peak {
        double at, width;
    };
    std::vector<Peak> all;
    // A single one stands near the middle, so that its contact does not reach the ends.
    const double margin = peaks == 1 ? 0.4 : 0.25;
    for (std::size_t i = 0; i < peaks; ++i) {
        const double place =
            (static_cast<double>(i) + random.uniform(margin, 1 - margin)) / static_cast<double>(peaks);
        all.push_back({place, peaks == 1 ? 1 : random.uniform(0.7, 1)});
    }
    std::vector<double> depth(static_cast<std::size_t>(nodes));
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(nodes - (wraps ? 0 : 1));
        depth[i] = std::numeric_limits<double>::infinity();
        for (const Peak& peak : all) {
            const double away = std::abs(x - peak.at);
            depth[i] = std::min(depth[i], (wraps ? std::min(away, 1 - away) : away) / peak.width);
        }
    }
    std::vector<int> order(depth.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return depth[static_cast<std::size_t>(a)] < depth[static_cast<std::size_t>(b)];
    });
    return order;
}

double within(double value, double from, double to) { return std::clamp(value, from, std::max(from, to)); }

Series drawn_series(const DesignSetup& setup, double H, double gamma, double lambda) {
    const GeneBounds& b = setup.bounds;
    Series series{1,
                  within(H, b.H_from, b.H_to),
                  within(gamma, b.gamma_from, b.gamma_to),
                  within(lambda, std::max(b.lambda_from, setup.limits.shortest_wave), b.lambda_to),
                  {}};
    return series;
}

constexpr Index shaping_nodes = 256;

} // namespace

Genome shaped_start(const DesignSetup& given, ga::Stream random) {
    const DesignSetup setup = completed(given);
    const Goal& goal = setup.goals.front();
    Grid grid = setup.model.grid;
    grid.nodes = std::min(grid.nodes, shaping_nodes);
    const double L = grid.length, infinity = std::numeric_limits<double>::infinity();
    const double last_pressure = setup.max_pressure        ? *setup.max_pressure
                                 : goal.against_pressure() ? goal.last()
                                                           : infinity;
    InverseProfile inverse = inverse_profile(
        grid.nodes, grid.spacing(), setup.model.body, drawn_order(grid.nodes, grid.wraps, random),
        advance_for(goal, grid.nodes), last_pressure, goal.against_pressure() ? infinity : goal.last());
    if (setup.max_pressure)
        inverse = with_range_at_last(std::move(inverse));
    const double gamma = random.uniform(1.3, 1.6);
    const double H = random.uniform(0.8, 1.6);
    const double lambda = L * random.uniform(1.2, 2.0);
    const std::vector<Series> series{drawn_series(setup, H, gamma, lambda),
                                     drawn_series(setup, H * random.uniform(0.8, 1.2),
                                                  gamma * random.uniform(1.05, 1.2),
                                                  lambda * random.uniform(0.6, 0.9))};
    return shaped_as(inverse.profile, series, setup.limits.shortest_wave);
}

Genome drawn_start(const DesignSetup& given, ga::Stream random) {
    const DesignSetup setup = completed(given);
    Genome genome{1, {}};
    for (int s = 0; s < 2; ++s) {
        Series series = drawn_series(setup, random.uniform(0.5, 1.5), random.uniform(1.4, 2.0),
                                     setup.model.grid.length * (s == 0 ? 1 : random.uniform(0.6, 1.6)));
        series.A = s == 0 ? 1 : std::exp(random.uniform(-1.5, 1.5));
        for (int n = 1; n <= last_chromosome(series.lambda, series.gamma, setup.limits.shortest_wave); ++n)
            series.chromosomes.push_back({n, {random.uniform(0, 2 * std::numbers::pi)}});
        genome.series.push_back(series);
    }
    return genome;
}

Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome) {
    if (setup.max_pressure)
        return genome;
    const Goal& goal = setup.goals.front();
    Model model = setup.model;
    model.loading = {std::max(40, model.loading.steps), model.loading.reach};
    const Response response = respond(folded(genome), model);
    const double own =
        goal.against_pressure() ? response.pressure.tail(1)[0] : response.displacement.tail(1)[0];
    // Misfit over the part of the goal that this amplitude covers; what it does not counts as missed wholly.
    const auto misfit_at = [&](double scale) {
        const Curve curve = curve_of(goal.quantity, scaled(response, scale));
        double worst = 0;
        for (Index k = 0; k < goal.points(); ++k)
            worst = std::max(worst, goal.x[k] > curve.to ? 1 : std::abs(curve.at(goal.x[k]) / goal.y[k] - 1));
        return worst;
    };
    const double least = goal.last() / own;
    double best = least, misfit = std::numeric_limits<double>::infinity(), ratio = std::pow(2.0, 0.5);
    for (int i = 0; i < 33; ++i) {
        const double scale = least * std::pow(ratio, i);
        if (const double here = misfit_at(scale); here < misfit)
            best = scale, misfit = here;
    }
    for (int round = 0; round < 12; ++round) {
        ratio = std::sqrt(ratio);
        for (const double scale : {best * ratio, best / ratio})
            if (const double here = misfit_at(scale); here < misfit)
                best = scale, misfit = here;
    }
    Genome fitted = folded(genome);
    fitted.scale = best;
    return folded(fitted);
}

} // namespace rough
