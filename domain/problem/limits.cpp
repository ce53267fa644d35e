#include "domain/problem/limits.hpp"

#include <numbers>

namespace rough {
namespace {

/// A point of the surface, mm, and the unit vector of a direction there.
struct Location {
    double x = 0, y = 0, along_x = 1, along_y = 0;
};

/// The genome's waves; those of a line run along x.
std::vector<PlaneWave> waves_on(const Grid& grid, const Genome& genome) {
    if (grid.is_2d()) return plane_waves(genome, grid);
    std::vector<PlaneWave> all;
    for (const Wave& w : waves(genome)) all.push_back({w.amplitude, w.wave_number, 0, w.phase});
    return all;
}

/// The derivative of order 0, 1 or 2 of the surface at a place, in its direction.
double derivative(const std::vector<PlaneWave>& waves, int order, const Location& at) {
    double value = 0;
    for (const PlaneWave& w : waves) {
        const double angle = w.k_x * at.x + w.k_y * at.y + w.phase;
        const double k = w.k_x * at.along_x + w.k_y * at.along_y;
        if (order == 0)
            value -= w.amplitude * std::cos(angle);
        else if (order == 1)
            value += w.amplitude * k * std::sin(angle);
        else
            value += w.amplitude * k * k * std::cos(angle);
    }
    return value;
}

/// The most by which a derivative of that order exceeds its values at nodes with spacing h: h^2/8 times a
/// bound on its second derivative. On a map the bounds along x and y add up to k^2 for each wave.
double between_nodes(const std::vector<PlaneWave>& waves, int order, double h) {
    double bound = 0;
    for (const PlaneWave& w : waves)
        bound += h * h / 8 * std::abs(w.amplitude) * std::pow(std::hypot(w.k_x, w.k_y), order + 2);
    return bound;
}

/// The grid on which extremes are searched; a coarser one for maps, which have the square of the nodes. Its
/// outer nodes stand on the edges, where slopes and heights may be largest.
Grid search_grid(const Grid& grid) {
    Grid fine = refined(grid, grid.is_2d() ? 4 : 8);
    if (fine.has_cells()) { // one cell more, half of it beyond each edge
        const double dx = fine.spacing(), dy = fine.row_spacing();
        fine.nodes += 1, fine.rows += 1;
        fine.length += dx, fine.width += dy;
        fine.from -= dx / 2, fine.from_y -= dy / 2;
    }
    return fine;
}

struct Extremes {
    double min, max;         ///< values at the nodes
    Location at_min, at_max; ///< their places
    double between;          ///< the most by which a point between nodes exceeds them
    double largest() const { return std::max(-min, max) + between; }
    double range() const { return max - min + 2 * between; }
};

/// Extremes of heights, slopes or curvatures; on a map of gradients or of principal curvatures.
Extremes extremes(const std::vector<PlaneWave>& waves, const Grid& grid, int order) {
    const Grid fine = search_grid(grid);
    const auto field = [&](int along_x) {
        std::vector<PlaneWave> each = waves;
        for (PlaneWave& w : each) { // d/ds of -cos(s) is -cos(s + pi/2)
            w.amplitude *= std::pow(w.k_x, along_x) * std::pow(w.k_y, order - along_x);
            w.phase += order * std::numbers::pi / 2;
        }
        return sampled(each, fine);
    };
    const bool is_map = grid.is_2d();
    const Eigen::VectorXd x = field(order), y = is_map && order > 0 ? field(0) : x,
                          xy = is_map && order > 1 ? field(1) : x;
    Extremes result{HUGE_VAL, -HUGE_VAL, {}, {}, between_nodes(waves, order, fine.widest_spacing())};
    const auto consider = [&](Index node, double value, double angle) {
        const Location at{fine.first_x() + fine.spacing() * static_cast<double>(node % fine.nodes),
                          fine.first_y() + fine.row_spacing() * static_cast<double>(node / fine.nodes), std::cos(angle),
                          std::sin(angle)};
        if (value > result.max) result.max = value, result.at_max = at;
        if (value < result.min) result.min = value, result.at_min = at;
    };
    for (Index i = 0; i < x.size(); ++i)
        if (!is_map || order == 0) {
            consider(i, x[i], 0);
        } else if (order == 1) {
            consider(i, std::hypot(x[i], y[i]), std::atan2(y[i], x[i]));
        } else {
            const double mean = 0.5 * (x[i] + y[i]), half = std::hypot(0.5 * (x[i] - y[i]), xy[i]);
            const double angle = 0.5 * std::atan2(2 * xy[i], x[i] - y[i]);
            consider(i, mean + half, angle);
            consider(i, mean - half, angle + std::numbers::pi / 2);
        }
    return result;
}

/// A limit on shape as a functional of the surface: the sum of weights times derivatives at places.
struct ShapeLimit {
    double ratio; ///< value over limit; for a radius, of the curvature
    int order;
    std::vector<std::pair<double, Location>> places; ///< weight (1/limit, signed)
};

std::vector<ShapeLimit> shape_limits(const Genome& genome, const Grid& grid, const MakingLimits& limits) {
    const auto all = waves_on(grid, genome);
    std::vector<ShapeLimit> result;
    const auto largest = [&](int order, double limit) {
        const Extremes e = extremes(all, grid, order);
        const bool up = e.max >= -e.min;
        result.push_back({e.largest() / limit, order, {{(up ? 1 : -1) / limit, up ? e.at_max : e.at_min}}});
    };
    if (limits.max_slope < MakingLimits::none) largest(1, limits.max_slope);
    if (limits.max_height < MakingLimits::none) {
        const Extremes e = extremes(all, grid, 0);
        result.push_back({e.range() / limits.max_height,
                          0,
                          {{1 / limits.max_height, e.at_max}, {-1 / limits.max_height, e.at_min}}});
    }
    if (limits.min_radius > 0) largest(2, 1 / limits.min_radius);
    return result;
}

double value_at(const Genome& genome, const ShapeLimit& limit, const Grid& fine) {
    const auto all = waves_on(fine, genome);
    const double between = between_nodes(all, limit.order, fine.widest_spacing());
    double value = 0;
    for (const auto& [weight, at] : limit.places)
        value += weight * derivative(all, limit.order, at) + std::abs(weight) * between;
    return value;
}

} // namespace

std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach, const ChosenChromosomes& chosen) {
    std::vector<ga::Variable> variables;
    const auto places = gene_places(genome);
    const auto values = genes(genome);
    for (std::size_t g = 0; g < places.size(); ++g)
        if (places[g].kind == GenePlace::Kind::phase && (!chosen || chosen(places[g].series, places[g].chromosome))) {
            const double half = reach.relative * std::abs(values[g]) + reach.absolute;
            variables.push_back({g, values[g] - half, values[g] + half});
        }
    return variables;
}

std::vector<Margin> margins(const Genome& genome, const Grid& grid, const MakingLimits& limits) {
    const auto all = waves_on(grid, genome);
    return {{"shortest_wave_mm", limits.shortest_wave, shortest_wave(genome) * (1 + 1e-12), true},
            {"slope", limits.max_slope, extremes(all, grid, 1).largest(), false},
            {"height_mm", limits.max_height, extremes(all, grid, 0).range(), false},
            {"radius_mm", limits.min_radius, 1 / extremes(all, grid, 2).largest(), true}};
}

double excess(const Genome& genome, const Grid& grid, const MakingLimits& limits) {
    double sum = 0;
    if (limits.any_shape())
        for (const ShapeLimit& limit : shape_limits(genome, grid, limits)) sum += std::max(0.0, limit.ratio - 1);
    return sum;
}

ga::Sensitivity limit_rows(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard,
                           const Eigen::RowVectorXd& d_scale) {
    const auto all = shape_limits(genome, grid, limits);
    const std::vector<double> values = genes(genome);
    const Grid fine = search_grid(grid);
    ga::Sensitivity rows{Eigen::VectorXd::Zero(static_cast<Index>(all.size())),
                         Eigen::MatrixXd::Zero(static_cast<Index>(all.size()), static_cast<Index>(values.size()))};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto row = static_cast<Index>(i);
        rows.residuals[row] = std::max(0.0, all[i].ratio - (1 - guard));
        if (rows.residuals[row] == 0) continue;
        if (d_scale.size() > 0) // the profile is proportional to its scale
            rows.jacobian.row(row) += value_at(genome, all[i], fine) / genome.scale * d_scale;
        for (std::size_t g = 0; g < values.size(); ++g) {
            const double h = 1e-6 * std::max(1.0, std::abs(values[g]));
            auto up = values, down = values;
            up[g] += h;
            down[g] -= h;
            rows.jacobian(row, static_cast<Index>(g)) +=
                (value_at(with_genes(genome, up), all[i], fine) - value_at(with_genes(genome, down), all[i], fine)) /
                (2 * h);
        }
    }
    return rows;
}

} // namespace rough
