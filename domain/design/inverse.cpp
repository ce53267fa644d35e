#include "domain/design/inverse.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"

#include <Eigen/Cholesky>

namespace rough {
namespace {

/// H on all nodes in contact order: displacement (mm) per unit of pressure (MPa).
Eigen::MatrixXd influence_in_order(const Profile& surface, const Body& given, const std::vector<int>& order) {
    const Body body = completed(given, profile_length(surface, given.kernel));
    const Index nodes = surface.nodes(), columns = surface.shape().columns;
    const double spacing = surface.spacing;
    const Eigen::VectorXd column = influence_column(in_units(body, spacing, surface.row_spacing), surface.shape()) *
                                   (spacing / body.effective_modulus);
    return Eigen::MatrixXd::NullaryExpr(nodes, nodes, [&](Index i, Index k) {
        const Index a = order[static_cast<std::size_t>(i)], b = order[static_cast<std::size_t>(k)];
        return column[std::abs(a / columns - b / columns) * columns + std::abs(a % columns - b % columns)];
    });
}

/// Depth of each node below contact at the end of loading, mm; 0 if it touches.
Eigen::VectorXd depths(const InverseProfile& inverse) {
    return (inverse.lowest_free - inverse.profile.heights).cwiseMax(0.0);
}

/// Multiplies these depths by a factor.
InverseProfile with_scaled_depths(InverseProfile inverse, const Eigen::VectorXd& depths, double factor) {
    Eigen::VectorXd& heights = inverse.profile.heights;
    heights = (depths.array() > 0).select(inverse.lowest_free - factor * depths, heights);
    return inverse;
}

/// A rising piecewise linear y(x), x >= 0, and its inverse.
class Rising {
  public:
    Rising(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
        const Index n = x.size();
        const double first_slope = n > 1 ? std::max(0.0, (y[1] - y[0]) / (x[1] - x[0])) : 0.5 * y[0] / x[0];
        points_.emplace_back(0.0, std::max(0.0, y[0] - first_slope * x[0]));
        for (Index k = 0; k < n; ++k) points_.emplace_back(x[k], std::max(points_.back().second, y[k]));
        const auto& [x_last, y_last] = points_.back();
        const auto& [x_before, y_before] = points_[points_.size() - 2];
        const double slope = std::max((y_last - y_before) / (x_last - x_before), 0.05 * y_last / x_last);
        points_.emplace_back(x_last * 1000, y_last + slope * x_last * 999);
    }
    /// The first x at which y reaches the value.
    double reaches(double value) const {
        if (value <= points_.front().second) return 0;
        const auto above = std::ranges::find_if(points_, [&](const auto& point) { return point.second >= value; });
        if (above == points_.end()) return points_.back().first;
        const auto below = above - 1;
        return below->first + (above->first - below->first) * (value - below->second) / (above->second - below->second);
    }

  private:
    std::vector<std::pair<double, double>> points_;
};

/// K(P) of a load curve: secants from (0, 0), at their mean pressures.
Rising stiffness_of(const Target& target) {
    Eigen::VectorXd P(target.points()), K(target.points());
    double x = 0, y = 0;
    for (Index k = 0; k < target.points(); ++k) {
        P[k] = 0.5 * (target.y[k] + y);
        K[k] = std::max(0.0, target.y[k] - y) / (target.x[k] - x);
        x = target.x[k], y = target.y[k];
    }
    return {P, K};
}

} // namespace

InverseProfile inverse_profile(const Profile& surface, const Body& body, const std::vector<int>& order,
                               const Advance& advance, double last_pressure, double last_displacement) {
    const Index nodes = surface.nodes();
    const Eigen::MatrixXd H = influence_in_order(surface, body, order);
    // The periodic half-space's H is singular on all nodes, so the last node never touches.
    const Index max_touching = body.relative_to_mean() ? nodes - 1 : nodes;
    const Eigen::LLT<Eigen::MatrixXd> factor(H.topLeftCorner(max_touching, max_touching));
    if (factor.info() != Eigen::Success)
        throw InputError("inverse contact: the influence matrix is not positive definite; choose a datum "
                         "beyond (L + delta)/4");
    const Eigen::MatrixXd L = factor.matrixL();
    const Eigen::VectorXd z = L.triangularView<Eigen::Lower>().solve(Eigen::VectorXd::Ones(max_touching));
    // P is the sum of pressures over L/delta, on a map over N.
    const double cell = surface.is_2d() ? 1 : surface.spacing;
    const double whole = surface.is_2d() ? elements(surface, body.kernel) : profile_length(surface, body.kernel);
    Eigen::VectorXd stiffness(max_touching);
    for (Index k = 0; k < max_touching; ++k) // sum of H_AA^-1 1 is z.z
        stiffness[k] = z.head(k + 1).squaredNorm() * cell / whole;
    const std::vector<double> steps = advance(stiffness);

    Eigen::VectorXd u = Eigen::VectorXd::Zero(nodes), gap = Eigen::VectorXd::Zero(nodes), lowest;
    double displacement = 0, pressure = 0;
    InverseProfile result{surface, {0}, 0, 0, Eigen::VectorXd(nodes)};
    const auto end_load = [&](double part, double K, const Eigen::VectorXd& ends) {
        result.last_displacement = displacement + part;
        result.last_pressure = pressure + part * K;
        lowest = ends.array() - result.last_displacement;
    };
    for (Index k = 0; k + 1 < nodes; ++k) {
        const double step = k < max_touching ? steps[static_cast<std::size_t>(k)] : 0;
        if (step > 0) {
            const Eigen::VectorXd w =
                L.topLeftCorner(k + 1, k + 1).transpose().triangularView<Eigen::Upper>().solve(z.head(k + 1));
            const Eigen::VectorXd punch = H.leftCols(k + 1) * w; // 1 on the contact set
            const double part = std::min((last_pressure - pressure) / stiffness[k], last_displacement - displacement);
            if (lowest.size() == 0 && part <= step) end_load(part, stiffness[k], u + part * punch);
            u += step * punch;
            displacement += step;
            pressure += step * stiffness[k];
        }
        gap[k + 1] = displacement - u[k + 1];
        result.entry.push_back(displacement);
    }
    if (lowest.size() == 0) // all nodes but one touch at the end of loading
        end_load(std::min((last_pressure - pressure) / stiffness[max_touching - 1], last_displacement - displacement),
                 stiffness[max_touching - 1], displacement - gap.array());
    result.profile.heights(order) = -gap;
    result.lowest_free(order) = lowest;
    return result;
}

InverseProfile with_range_at_last(InverseProfile inverse) {
    const Eigen::VectorXd below = depths(inverse);
    // The largest factor whose lowest height is -last_displacement.
    double factor = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < below.size(); ++i)
        if (below[i] > 1e-9 * inverse.last_displacement)
            factor = std::min(factor, (inverse.lowest_free[i] + inverse.last_displacement) / below[i]);
    return std::isfinite(factor) ? with_scaled_depths(std::move(inverse), below, factor) : inverse;
}

InverseProfile with_mean_at_full_approach(InverseProfile inverse, double reach) {
    const Eigen::VectorXd below = depths(inverse);
    if (!(below.sum() > 1e-9 * inverse.last_displacement)) return inverse;
    // The body's mean plane does not move: lowest_free has the mean -last_displacement.
    const double factor = (1 / reach - 1) * inverse.last_displacement * static_cast<double>(below.size()) / below.sum();
    return with_scaled_depths(std::move(inverse), below, factor);
}

Advance advance_for(const Target& target, Index nodes) {
    const bool by_area = is_contact_fraction(target.quantity);
    const Rising curve =
        target.quantity == Quantity::load_at_displacement ? stiffness_of(target) : Rising(target.x, target.y);
    return [=, quantity = target.quantity](const Eigen::VectorXd& stiffness) {
        const auto sets = static_cast<std::size_t>(stiffness.size());
        // Pressure or displacement at which the first k + 1 nodes become the contact set.
        std::vector<double> begins(sets + 1, 0.0);
        Eigen::VectorXd K = stiffness; // on a periodic body K_i = K, and not all nodes touch
        if (quantity == Quantity::interface_stiffness && stiffness.size() == nodes)
            for (double& each : K) each = interface_of(each, stiffness[nodes - 1]);
        for (std::size_t k = 1; k < sets; ++k)
            begins[k] =
                std::max(begins[k - 1],
                         curve.reaches(by_area ? (static_cast<double>(k) + 0.5) / static_cast<double>(nodes)
                                               : 0.5 * (K[static_cast<Index>(k) - 1] + K[static_cast<Index>(k)])));
        begins[sets] = begins[sets - 1];
        std::vector<double> steps(sets);
        for (std::size_t k = 0; k < sets; ++k) {
            steps[k] = begins[k + 1] - begins[k];
            if (quantity != Quantity::area_at_displacement) // a pressure
                steps[k] /= stiffness[static_cast<Index>(k)];
        }
        return steps;
    };
}

} // namespace rough
