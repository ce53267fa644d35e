#include "domain/accuracy/window.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <limits>

namespace rough {

namespace {

/// P' at the displacements, 0 where there is no approach, infinite beyond full contact.
Eigen::VectorXd pressures_at(const Profile& profile, const Body& body,
                             const std::vector<double>& displacements, const ContactOptions& options) {
    const double full = body.relative_to_mean() ? displacement_range(profile, body.kernel)
                                                : std::numeric_limits<double>::infinity();
    std::vector<double> within;
    for (const double displacement : displacements)
        if (displacement > 0 && displacement <= full)
            within.push_back(displacement);
    const ContactCurve curve = solve_contact(profile, body, within, options);
    Eigen::VectorXd pressures(static_cast<Index>(displacements.size()));
    std::size_t solved = 0;
    for (Index j = 0; j < pressures.size(); ++j) {
        const double displacement = displacements[static_cast<std::size_t>(j)];
        pressures[j] = displacement <= 0     ? 0
                       : displacement > full ? std::numeric_limits<double>::infinity()
                                             : curve.steps[solved++].pressure;
    }
    return pressures;
}

std::vector<double> shifted(std::vector<double> displacements, double by) {
    for (double& displacement : displacements)
        displacement += by;
    return displacements;
}

} // namespace

Window window_between(const Profile& whole, const Profile& reduced) {
    if (whole.nodes() != reduced.nodes() || whole.spacing != reduced.spacing)
        throw InputError("window: profiles on different nodes given, expected the same nodes");
    const Eigen::VectorXd f = (reduced.heights.array() - reduced.heights.maxCoeff()) -
                              (whole.heights.array() - whole.heights.maxCoeff());
    return {std::min(f.minCoeff(), 0.0), std::max(f.maxCoeff(), 0.0)};
}

Bounds pressure_bounds(const Profile& reduced, const Window& window, const Body& body,
                       const std::vector<double>& displacements, const ContactOptions& options) {
    return {pressures_at(reduced, body, shifted(displacements, -window.highest), options),
            pressures_at(reduced, body, shifted(displacements, -window.lowest), options)};
}

Bounds pressure_bounds(const std::vector<LoadStep>& steps, Index count, const Window& window) {
    Bounds bounds{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    for (Index j = 0; j < count; ++j) {
        const LoadStep& step = steps[static_cast<std::size_t>(j)];
        bounds.lower[j] = std::max(0.0, step.pressure - window.highest * step.tangent_stiffness);
        if (window.lowest == 0) {
            bounds.upper[j] = step.pressure;
            continue;
        }
        const double reach = step.displacement - window.lowest;
        const auto beyond = std::find_if(steps.begin() + j, steps.end(),
                                         [&](const LoadStep& s) { return s.displacement >= reach; });
        bounds.upper[j] = beyond == steps.end() ? std::numeric_limits<double>::infinity()
                                                : step.pressure - window.lowest * beyond->tangent_stiffness;
    }
    return bounds;
}

} // namespace rough
