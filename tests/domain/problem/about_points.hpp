#pragma once

#include "domain/response/response.hpp"

namespace rough::testing {

/// The load steps of a verification, as shares of the last displacement: those of a response, and two about each of
/// the pressures, as close as in `times` the load steps.
inline std::vector<double> shares_about(const Response& own, const Eigen::VectorXd& pressures, int times) {
    const double last = own.displacement.tail(1)[0], width = 1. / static_cast<double>(own.steps() * times);
    std::vector<double> all, about;
    for (const double displacement : own.displacement) all.push_back(displacement / last);
    for (const double pressure : pressures) {
        Index b = 0;
        while (b + 1 < own.steps() && own.pressure[b] < pressure) ++b;
        const auto before = [&](const Eigen::VectorXd& column) { return b > 0 ? column[b - 1] : 0; };
        const double from = before(own.displacement), h = own.displacement[b] - from;
        // Hermite's cubic through the pressures and tangents at the ends of the load step.
        const auto at = [&](double t) {
            return (1 + 2 * t) * (1 - t) * (1 - t) * before(own.pressure) +
                   t * (1 - t) * (1 - t) * h * before(own.tangent_stiffness) + t * t * (3 - 2 * t) * own.pressure[b] -
                   t * t * (1 - t) * h * own.tangent_stiffness[b];
        };
        double low = 0, high = 1;
        while (high - low > 1e-13) (at((low + high) / 2) < pressure ? low : high) = (low + high) / 2;
        const double middle = std::clamp((from + high * h) / last, width, 1 - width / 2);
        about.push_back(middle - width / 2);
        about.push_back(middle + width / 2);
    }
    std::sort(about.begin(), about.end());
    for (const double share : about) // unless another is closer than half as much
        if (std::none_of(all.begin(), all.end(),
                         [&](double one) { return std::abs(one - share) < width / 2 * (1 - 1e-9); }))
            all.push_back(share);
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace rough::testing
