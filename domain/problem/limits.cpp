#include "domain/problem/limits.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// The derivative of order 0, 1 or 2 of the profile at x.
double derivative(const std::vector<Wave>& waves, int order, double x) {
    double value = 0;
    for (const Wave& w : waves) {
        const double angle = w.wave_number * x + w.phase, k = w.wave_number;
        if (order == 0)
            value -= w.amplitude * std::cos(angle);
        else if (order == 1)
            value += w.amplitude * k * std::sin(angle);
        else
            value += w.amplitude * k * k * std::cos(angle);
    }
    return value;
}

/// What the derivative of that order may exceed its values at nodes h apart by: h^2/8 times a bound on its
/// own second derivative.
double between_nodes(const std::vector<Wave>& waves, int order, double h) {
    double bound = 0;
    for (const Wave& w : waves)
        bound += h * h / 8 * std::abs(w.amplitude) * std::pow(w.wave_number, order + 2);
    return bound;
}

constexpr Index finer = 8; ///< than the model's grid

struct Extremes {
    double least, greatest;     ///< at the nodes
    double x_least, x_greatest; ///< mm
    double between;             ///< what a point between nodes may exceed them by
    double largest() const { return std::max(-least, greatest) + between; }
    double range() const { return greatest - least + 2 * between; }
};

Extremes extremes(const std::vector<Wave>& waves, const Grid& grid, int order) {
    const Grid fine = refined(grid, finer);
    const double h = fine.spacing();
    Eigen::ArrayXd values = Eigen::ArrayXd::Zero(fine.nodes);
    for (const Wave& w : waves) {
        // The rotation by k h, restarted every 64 nodes so that rounding does not build up.
        const double k = w.wave_number;
        const double size = w.amplitude * std::pow(k, order);
        const double c = std::cos(k * h), s = std::sin(k * h);
        double cosine = 0, sine = 0;
        for (Index i = 0; i < fine.nodes; ++i) {
            if (i % 64 == 0) {
                const double angle = k * h * static_cast<double>(i) + w.phase;
                cosine = std::cos(angle);
                sine = std::sin(angle);
            }
            values[i] += size * (order == 0 ? -cosine : order == 1 ? sine : cosine);
            const double next = cosine * c - sine * s;
            sine = sine * c + cosine * s;
            cosine = next;
        }
    }
    Index low = 0, high = 0;
    Extremes result{values.minCoeff(&low), values.maxCoeff(&high), 0, 0, between_nodes(waves, order, h)};
    result.x_least = h * static_cast<double>(low);
    result.x_greatest = h * static_cast<double>(high);
    return result;
}

/// One limit on shape as a functional of the profile: sum of weights times derivatives at places.
struct ShapeLimit {
    double ratio; ///< value over limit; a radius as curvature
    int order;
    std::vector<std::pair<double, double>> places; ///< weight (1/limit, signed), x
};

std::vector<ShapeLimit> shape_limits(const Genome& genome, const Grid& grid, const MakingLimits& limits) {
    const auto all = waves(genome);
    std::vector<ShapeLimit> result;
    const auto largest = [&](int order, double limit) {
        const Extremes e = extremes(all, grid, order);
        const bool up = e.greatest >= -e.least;
        result.push_back(
            {e.largest() / limit, order, {{(up ? 1 : -1) / limit, up ? e.x_greatest : e.x_least}}});
    };
    if (limits.largest_slope > 0)
        largest(1, limits.largest_slope);
    if (limits.largest_height > 0) {
        const Extremes e = extremes(all, grid, 0);
        result.push_back(
            {e.range() / limits.largest_height,
             0,
             {{1 / limits.largest_height, e.x_greatest}, {-1 / limits.largest_height, e.x_least}}});
    }
    if (limits.smallest_radius > 0)
        largest(2, 1 / limits.smallest_radius);
    return result;
}

double value_at(const Genome& genome, const ShapeLimit& limit, double h) {
    const auto all = waves(genome);
    const double between = between_nodes(all, limit.order, h);
    double value = 0;
    for (const auto& [weight, x] : limit.places)
        value += weight * derivative(all, limit.order, x) + std::abs(weight) * between;
    return value;
}

} // namespace

std::vector<Margin> margins(const Genome& genome, const Grid& grid, const MakingLimits& limits) {
    const auto all = waves(genome);
    return {{"shortest_wave_mm", limits.shortest_wave, shortest_wave(genome) * (1 + 1e-12), true},
            {"slope", limits.largest_slope, extremes(all, grid, 1).largest(), false},
            {"height_mm", limits.largest_height, extremes(all, grid, 0).range(), false},
            {"radius_mm", limits.smallest_radius, 1 / extremes(all, grid, 2).largest(), true}};
}

double excess(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard) {
    double sum = 0;
    if (limits.any_shape())
        for (const ShapeLimit& limit : shape_limits(genome, grid, limits))
            sum += std::max(0.0, limit.ratio - (1 - guard));
    return sum;
}

LimitRows limit_rows(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard,
                     const Eigen::RowVectorXd& d_scale) {
    const auto all = shape_limits(genome, grid, limits);
    const std::vector<double> values = genes(genome);
    const double spacing = refined(grid, finer).spacing();
    LimitRows rows{Eigen::VectorXd::Zero(static_cast<Index>(all.size())),
                   Eigen::MatrixXd::Zero(static_cast<Index>(all.size()), static_cast<Index>(values.size()))};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto row = static_cast<Index>(i);
        rows.residuals[row] = std::max(0.0, all[i].ratio - (1 - guard));
        if (rows.residuals[row] == 0)
            continue;
        if (d_scale.size() > 0) // the profile is proportional to its scale
            rows.jacobian.row(row) += value_at(genome, all[i], spacing) / genome.scale * d_scale;
        for (std::size_t g = 0; g < values.size(); ++g) {
            const double h = 1e-6 * std::max(1.0, std::abs(values[g]));
            auto up = values, down = values;
            up[g] += h;
            down[g] -= h;
            rows.jacobian(row, static_cast<Index>(g)) +=
                (value_at(with_genes(genome, up), all[i], spacing) -
                 value_at(with_genes(genome, down), all[i], spacing)) /
                (2 * h);
        }
    }
    return rows;
}

} // namespace rough
