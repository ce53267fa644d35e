#include "domain/profile/roughness.hpp"

#include "domain/errors.hpp"

#include <array>
#include <cmath>
#include <string>

namespace rough {
namespace {

constexpr Index sections = 5; // ISO 21920-3, default number of section lengths

double mean_maximum_height(const Eigen::VectorXd& heights) {
    double sum = 0;
    for (Index s = 0; s < sections; ++s) {
        const Index from = heights.size() * s / sections, to = heights.size() * (s + 1) / sections;
        const auto section = heights.segment(from, to - from);
        sum += section.maxCoeff() - section.minCoeff();
    }
    return sum / sections;
}

/// Root mean square of a seven-point formula: weights of z_{i-3} .. z_{i+3} over the inner nodes.
double mean_square(const Eigen::VectorXd& heights, const std::array<double, 7>& weights, double divisor) {
    const Eigen::Map<const Eigen::Matrix<double, 7, 1>> w(weights.data());
    const Index inner = heights.size() - 6;
    double sum = 0;
    for (Index i = 0; i < inner; ++i) {
        const double value = w.dot(heights.segment<7>(i)) / divisor;
        sum += value * value;
    }
    return sum / static_cast<double>(inner);
}

} // namespace

Roughness roughness(const Profile& profile) {
    if (profile.nodes() < 2 * sections)
        throw InputError("roughness: a profile of " + std::to_string(profile.nodes()) +
                         " nodes, expected at least " + std::to_string(2 * sections));
    const Eigen::VectorXd heights = profile.heights.array() - profile.heights.mean();
    const Eigen::ArrayXd z = heights.array();
    Roughness r;
    r.Ra = z.abs().mean();
    r.m0 = z.square().mean();
    r.Rq = std::sqrt(r.m0);
    if (!(r.Rq > 1e-14 * profile.heights.cwiseAbs().maxCoeff()))
        throw InputError("roughness: the profile is constant, expected a rough one");
    r.Rsk = z.cube().mean() / (r.Rq * r.m0);
    r.Rku = z.square().square().mean() / (r.m0 * r.m0);
    r.Rz = mean_maximum_height(heights);
    r.Rt = z.maxCoeff() - z.minCoeff();
    const double step = profile.spacing;
    r.m2 = mean_square(heights, {-1, 9, -45, 0, 45, -9, 1}, 60 * step); // ISO 21920-2, local gradient
    r.m4 = mean_square(heights, {2, -27, 270, -490, 270, -27, 2}, 180 * step * step);
    r.Rdq = std::sqrt(r.m2);
    r.rms_curvature = std::sqrt(r.m4);
    r.bandwidth = r.m0 * r.m4 / (r.m2 * r.m2);
    if (!std::isfinite(r.Rsk + r.Rku + r.m2 + r.m4 + r.bandwidth))
        throw InputError(
            "roughness: its parameters do not fit double precision, expected heights and a length "
            "nearer to 1 mm");
    return r;
}

} // namespace rough
