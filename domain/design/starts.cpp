#include "domain/design/starts.hpp"

#include "domain/design/inverse.hpp"
#include "domain/design/shape_to_waves.hpp"
#include "domain/mwm/sobol.hpp"
#include "ga/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace rough {

namespace {

/// Nodes by their depth, the least first.
std::vector<int> in_order_of(const std::vector<double>& depth) {
    std::vector<int> order(depth.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return depth[static_cast<std::size_t>(a)] < depth[static_cast<std::size_t>(b)];
    });
    return order;
}

/// drawn_order of an area: cones of like width, one near the middle or up to eight anywhere.
std::vector<int> drawn_area_order(const Profile& surface, const Grid& grid, ga::Stream& random) {
    const std::size_t peaks = random.chance(0.5) ? 1 : 2 + random.below(7);
    const double margin = peaks == 1 ? 0.4 : 0.1;
    std::vector<double> depth(static_cast<std::size_t>(surface.nodes()), HUGE_VAL);
    for (std::size_t p = 0; p < peaks; ++p) {
        const double x = grid.length * random.uniform(margin, 1 - margin),
                     y = grid.width * random.uniform(margin, 1 - margin),
                     width = peaks == 1 ? 1 : random.uniform(0.7, 1);
        const auto away = [&](double from, double to, double period) {
            const double straight = std::abs(from - to);
            return grid.periodic ? std::min(straight, period - straight) : straight;
        };
        const Index columns = surface.shape().columns;
        for (Index i = 0; i < surface.nodes(); ++i) {
            const double here =
                std::hypot(away(surface.spacing * static_cast<double>(i % columns), x, grid.length),
                           away(surface.row_spacing * static_cast<double>(i / columns), y, grid.width));
            double& least = depth[static_cast<std::size_t>(i)];
            least = std::min(least, here / width);
        }
    }
    return in_order_of(depth);
}

/// Where nodes touch first: peaks of a field over the profile, highest first. One asperity in half of the
/// cases, else up to eight, of equal height and like width.
std::vector<int> drawn_order(Index nodes, bool periodic, ga::Stream& random) {
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
        const double x = static_cast<double>(i) / static_cast<double>(nodes - (periodic ? 0 : 1));
        depth[i] = std::numeric_limits<double>::infinity();
        for (const Peak& peak : all) {
            const double away = std::abs(x - peak.at);
            depth[i] = std::min(depth[i], (periodic ? std::min(away, 1 - away) : away) / peak.width);
        }
    }
    return in_order_of(depth);
}

constexpr Index shaping_nodes = 256, shaping_side = 24;
/// Of a start on a periodic body in free amplitude: how far under contact its valleys end, over the last
/// displacement.
constexpr double deepest_free = 0.5;

} // namespace

Genome shaped_start(const DesignSetup& given, ga::Stream random) {
    const DesignSetup setup = completed(given);
    const Target& target = setup.targets.front();
    Grid grid = setup.model.grid;
    grid.nodes = std::min(grid.nodes, grid.is_2d() ? shaping_side : shaping_nodes);
    grid.rows = std::min(grid.rows, shaping_side);
    const Profile surface{Eigen::VectorXd(grid.shape().nodes()), grid.spacing(), grid.rows,
                          grid.row_spacing()};
    // A coarser grid asks for a farther datum; a start need only be near.
    Body body = setup.model.body;
    if (body.kernel == Kernel::free)
        body.datum = std::max(body.datum, 1.02 * grid.spacing() * static_cast<double>(grid.nodes) / 4);
    const double L = grid.length, infinity = std::numeric_limits<double>::infinity();
    const double last_pressure = setup.max_pressure          ? *setup.max_pressure
                                 : target.against_pressure() ? target.last()
                                                             : infinity;
    InverseProfile inverse = inverse_profile(surface, body,
                                             grid.is_2d() ? drawn_area_order(surface, grid, random)
                                                          : drawn_order(grid.nodes, grid.periodic, random),
                                             advance_for(target, surface.nodes()), last_pressure,
                                             target.against_pressure() ? infinity : target.last());
    if (grid.periodic && !grid.is_2d() && setup.max_pressure)
        inverse =
            with_mean_at_full_approach(std::move(inverse), completed(setup.model.loading, body.kernel).reach);
    else if (setup.max_pressure)
        inverse = with_range_at_last(std::move(inverse));
    else if (grid.periodic &&
             !grid.is_2d()) // as its stiffness has no end, neither have valleys beyond the load
        inverse.profile.heights = inverse.profile.heights.cwiseMax(
            (inverse.lowest_free.array() - deepest_free * inverse.last_displacement).matrix());
    const Eigen::VectorXd& heights = inverse.profile.heights;
    if (!(heights.maxCoeff() - heights.minCoeff() > 1e-9 * inverse.last_displacement))
        return drawn_start(setup, random); // all of the target is above full contact: flat answers best
    const double gamma = random.uniform(1.3, 1.6);
    const double H = random.uniform(0.8, 1.6);
    if (grid.is_2d())
        return shaped_as(inverse.profile, drawn_series(setup, H, gamma, L * random.uniform(0.9, 1.5)),
                         setup.ridges, grid, setup.limits.shortest_wave);
    if (grid.periodic)
        return shaped_as(inverse.profile, harmonic_series(L, setup.limits.shortest_wave, H),
                         setup.limits.shortest_wave);
    const double lambda = L * random.uniform(1.2, 2.0);
    const std::vector<Series> series{drawn_series(setup, H, gamma, lambda),
                                     drawn_series(setup, H * random.uniform(0.8, 1.2),
                                                  gamma * random.uniform(1.05, 1.2),
                                                  lambda * random.uniform(0.6, 0.9))};
    return shaped_as(inverse.profile, series, setup.limits.shortest_wave);
}

Genome fitting_grid(const DesignSetup& setup, const Genome& genome) {
    const bool takes_harmonics = setup.model.grid.periodic && !setup.model.grid.is_2d() && !setup.phases;
    return takes_harmonics ? in_harmonics(genome, setup.model.grid.length) : genome;
}

std::vector<Genome> database_starts(const DesignSetup& setup, int threads) {
    DatabaseLayout layout;
    layout.lambda = std::clamp(setup.model.grid.length, setup.bounds.lambda_from, setup.bounds.lambda_to);
    layout.H_from = std::clamp(layout.H_from, setup.bounds.H_from, setup.bounds.H_to);
    layout.H_to = std::clamp(layout.H_to, setup.bounds.H_from, setup.bounds.H_to);
    layout.gamma_from = std::clamp(layout.gamma_from, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.gamma_to = std::clamp(layout.gamma_to, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.shortest = setup.limits.shortest_wave;
    layout.ridges = setup.ridges;
    std::vector<Genome> genomes = sobol_database(layout);
    ga::parallel_for(genomes.size(), ga::thread_count(threads), [&](std::size_t i) {
        genomes[i] = with_fitting_amplitude(setup, fitting_grid(setup, genomes[i]));
    });
    return genomes;
}

} // namespace rough
