#include "domain/design/starts.hpp"

#include "domain/design/advance.hpp"
#include "domain/design/shape_to_waves.hpp"
#include "domain/problem/harmonics.hpp"

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

constexpr Index shaping_nodes = 256;

} // namespace

Genome shaped_start(const DesignSetup& given, ga::Stream random) {
    const DesignSetup setup = completed(given);
    const Target& target = setup.targets.front();
    Grid grid = setup.model.grid;
    grid.nodes = std::min(grid.nodes, shaping_nodes);
    // A coarser grid asks for a farther datum; a start need only be near.
    Body body = setup.model.body;
    if (body.kernel == Kernel::free)
        body.datum = std::max(body.datum, 1.02 * grid.spacing() * static_cast<double>(grid.nodes) / 4);
    const double L = grid.length, infinity = std::numeric_limits<double>::infinity();
    const double last_pressure = setup.max_pressure          ? *setup.max_pressure
                                 : target.against_pressure() ? target.last()
                                                             : infinity;
    InverseProfile inverse = inverse_profile(
        grid.nodes, grid.spacing(), body, drawn_order(grid.nodes, grid.wraps, random),
        advance_for(target, grid.nodes), last_pressure, target.against_pressure() ? infinity : target.last());
    if (setup.max_pressure)
        inverse = with_range_at_last(std::move(inverse));
    const Eigen::VectorXd& heights = inverse.profile.heights;
    if (!(heights.maxCoeff() - heights.minCoeff() > 1e-9 * inverse.last_displacement))
        return drawn_start(setup, random); // all of the target is above full contact: flat answers best
    const double gamma = random.uniform(1.3, 1.6);
    const double H = random.uniform(0.8, 1.6);
    if (grid.wraps)
        return shaped_as(inverse.profile, harmonic_series(L, setup.limits.shortest_wave, H),
                         setup.limits.shortest_wave);
    const double lambda = L * random.uniform(1.2, 2.0);
    const std::vector<Series> series{drawn_series(setup, H, gamma, lambda),
                                     drawn_series(setup, H * random.uniform(0.8, 1.2),
                                                  gamma * random.uniform(1.05, 1.2),
                                                  lambda * random.uniform(0.6, 0.9))};
    return shaped_as(inverse.profile, series, setup.limits.shortest_wave);
}

} // namespace rough
