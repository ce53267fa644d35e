#include "domain/accuracy/error_bounds.hpp"

#include "domain/errors.hpp"

namespace rough {
namespace {

/// P' at the displacements moved by `shift`, mm: 0 at negative displacements, infinite beyond full contact.
Eigen::VectorXd shifted_pressures(const Profile& profile, const Body& body, std::vector<double> displacements,
                                  double shift, const ContactOptions& options) {
    const double full = body.relative_to_mean() ? displacement_range(profile, body.kernel) : HUGE_VAL;
    std::vector<double> within;
    for (double& displacement : displacements) {
        displacement += shift;
        if (displacement > 0 && displacement <= full) within.push_back(displacement);
    }
    const ContactCurve curve = solve_contact(profile, body, within, options);
    Eigen::VectorXd pressures(static_cast<Index>(displacements.size()));
    auto solved = curve.steps.begin();
    std::transform(displacements.begin(), displacements.end(), pressures.begin(), [&](double displacement) {
        return displacement <= 0 ? 0 : displacement > full ? HUGE_VAL : (solved++)->pressure;
    });
    return pressures;
}

constexpr double weight_order = 3;              ///< the scatter's variance falls as N^-3
constexpr double safety = 2.3, thin_safety = 3; ///< thin: three grids, one more than a line needs

/// A weighted straight line in x = N^-order - resolved^-order. Its value at x = 0 is values * reading.
struct Line {
    Eigen::VectorXd x, weights, reading;
    double variance = 0; ///< variance of the value at x = 0, for scatter of unit weight

    Line(const std::vector<Index>& grids, Index resolved, double order)
        : x(static_cast<Index>(grids.size())), weights(x.size()) {
        for (Index i = 0; i < x.size(); ++i) {
            const auto n = static_cast<double>(grids[static_cast<std::size_t>(i)]);
            x[i] = std::pow(n, -order) - std::pow(static_cast<double>(resolved), -order);
            weights[i] = std::pow(n / static_cast<double>(grids.back()), weight_order);
        }
        const double s0 = weights.sum(), s1 = weights.dot(x), s2 = weights.dot(x.cwiseAbs2());
        const double determinant = s0 * s2 - s1 * s1;
        reading = weights.cwiseProduct(Eigen::VectorXd::Constant(x.size(), s2) - s1 * x) / determinant;
        variance = s2 / determinant;
    }

    /// Standard error of each row's value at x = 0.
    Eigen::VectorXd standard_error(const Eigen::MatrixXd& values) const {
        const Eigen::VectorXd at_zero = values * reading;
        const Eigen::VectorXd slope =
            (values.colwise() - at_zero) * weights.cwiseProduct(x) / weights.dot(x.cwiseAbs2());
        const Eigen::MatrixXd rest = (values.colwise() - at_zero) - slope * x.transpose();
        const double freedom = static_cast<double>(x.size() - 2);
        return (rest.cwiseAbs2() * weights * (variance / freedom)).cwiseSqrt();
    }
};

} // namespace

Eigen::VectorXd differences(const Eigen::VectorXd& pressure) {
    Eigen::VectorXd result = pressure;
    result.tail(pressure.size() - 1) -= pressure.head(pressure.size() - 1);
    return result;
}

ErrorScale error_scale(const Eigen::VectorXd& pressure, double light) {
    const double floor = light * pressure[pressure.size() - 1];
    ErrorScale scale{pressure.cwiseMax(floor), differences(pressure)};
    for (Index j = 0; j < pressure.size(); ++j)
        if (pressure[j] < floor) scale.difference[j] = std::max(scale.difference[j], floor);
    return scale;
}

Index light_rows(const Eigen::VectorXd& pressure) {
    return (pressure.array() < light_load * pressure[pressure.size() - 1]).count();
}

Doubt Doubt::known_up_to(Index rows, double offset) const {
    Doubt result = *this;
    result.pressure.head(rows).setZero();
    result.difference.head(rows).setZero();
    result.pressure.tail(pressure.size() - rows).array() += std::abs(offset);
    return result;
}

Doubt operator+(const Doubt& a, const Doubt& b) { return {a.pressure + b.pressure, a.difference + b.difference}; }

Doubt doubt_of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    const Eigen::VectorXd below = pressure - lower, above = upper - pressure;
    Doubt doubt{below.cwiseMax(above), below.cwiseMax(above)};
    for (Index j = 1; j < pressure.size(); ++j)
        doubt.difference[j] = std::max(above[j] + below[j - 1], below[j] + above[j - 1]);
    return doubt;
}

Doubt solver_doubt(const Response& rows, Index count, const Eigen::VectorXd& share) {
    const Index last = rows.steps() - 1;
    Eigen::VectorXd next_stiffness = rows.tangent_stiffness;
    next_stiffness.head(last) = rows.tangent_stiffness.tail(last);
    const Eigen::VectorXd error = share.cwiseProduct(rows.displacement).cwiseProduct(next_stiffness).head(count);
    return doubt_of(error, Eigen::VectorXd::Zero(count), 2 * error);
}

Eigen::VectorXd displacement_errors(const Response& rows, const Loading& loading) {
    const Eigen::ArrayXd pressure = rows.pressure;
    const Index last = rows.steps() - 1;
    Eigen::ArrayXd share = rows.kkt_residual;
    if (!loading.pressures.empty())
        share += (pressure / Eigen::Map<const Eigen::ArrayXd>(loading.pressures.data(), pressure.size()) - 1).abs();
    else if (loading.to_pressure)
        share += std::abs(pressure[last] / *loading.to_pressure - 1);
    return share;
}

Eigen::VectorXd relative(const Doubt& doubt, const ErrorScale& scale) {
    const Eigen::VectorXd pressure = doubt.pressure.cwiseQuotient(scale.pressure);
    const double last = pressure[pressure.size() - 1]; // the scale of light loads is a share of the last
    Eigen::VectorXd error = pressure.cwiseMax(doubt.difference.cwiseQuotient(scale.difference));
    for (double& each : error) each = std::max(each, last) < 1 ? each / (1 - std::max(each, last)) : HUGE_VAL;
    return error;
}

Index rows_to_know(const Doubt& doubt, const ErrorScale& scale, double accuracy) {
    Index known = scale.pressure.size();
    double worst = 0;
    accuracy /= 1 + accuracy; // relative to the curve's pressures, as in relative()
    for (Index j = known - 1; j >= 0; --j) {
        worst = std::max(worst, doubt.pressure[j] / scale.pressure[j]);
        if (!(std::max(worst, doubt.difference[j] / scale.difference[j]) <= accuracy)) break;
        if (j == 0 || worst + doubt.pressure[j - 1] / scale.pressure[j] <= accuracy) known = j;
    }
    return known;
}

double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved) {
    const ErrorScale scale = error_scale(resolved);
    const Eigen::VectorXd error = pressure - resolved;
    return std::max(error.cwiseAbs().cwiseQuotient(scale.pressure).maxCoeff(),
                    differences(error).cwiseAbs().cwiseQuotient(scale.difference).maxCoeff());
}

Window window_between(const Profile& whole, const Profile& reduced) {
    if (whole.nodes() != reduced.nodes() || whole.spacing != reduced.spacing)
        throw InputError("window: the two profiles have different nodes; sample both on one grid");
    const Eigen::VectorXd f =
        (reduced.heights.array() - reduced.heights.maxCoeff()) - (whole.heights.array() - whole.heights.maxCoeff());
    return {std::min(f.minCoeff(), 0.0), std::max(f.maxCoeff(), 0.0)};
}

Bounds pressure_bounds(const Profile& reduced, const Window& window, const Body& body,
                       const std::vector<double>& displacements, const ContactOptions& options) {
    return {shifted_pressures(reduced, body, displacements, -window.highest, options),
            shifted_pressures(reduced, body, displacements, -window.lowest, options)};
}

Bounds pressure_bounds(const std::vector<LoadStep>& steps, Index count, const Window& window) {
    Bounds bounds{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    for (Index j = 0; j < count; ++j) {
        const LoadStep& step = steps[static_cast<std::size_t>(j)];
        bounds.lower[j] = std::max(0.0, step.pressure - window.highest * step.tangent_stiffness);
        bounds.upper[j] = step.pressure;
        if (window.lowest == 0) continue;
        const auto beyond = std::find_if(steps.begin() + j, steps.end(), [&](const LoadStep& other) {
            return other.displacement >= step.displacement - window.lowest;
        });
        bounds.upper[j] -= beyond == steps.end() ? -HUGE_VAL : window.lowest * beyond->tangent_stiffness;
    }
    return bounds;
}

Extrapolation extrapolate(const std::vector<Index>& grids, const Eigen::MatrixXd& pressures, Index resolved,
                          double order) {
    const Line line(grids, resolved, order);
    Eigen::MatrixXd steps = pressures;
    steps.bottomRows(steps.rows() - 1) -= pressures.topRows(steps.rows() - 1);
    const double factor = grids.size() > 3 ? safety : thin_safety;
    // The larger of the distance from the last grid's value and the line's standard error, times the factor.
    const auto doubt = [&](const Eigen::MatrixXd& values) -> Eigen::VectorXd {
        const Eigen::VectorXd distance = (values * line.reading - values.rightCols(1)).cwiseAbs();
        return factor * distance.cwiseMax(line.standard_error(values));
    };
    return {(pressures * line.reading).cwiseMax(0), {doubt(pressures), doubt(steps)}};
}

} // namespace rough
