#pragma once

#include "domain/profile/profile.hpp"

#include <array>
#include <random>
#include <string>

namespace rough::testing {

/// A profile as workshops measure them, in mm.
struct NamedScan {
    std::string kind;       ///< its shape
    rough::Profile profile; ///< heights of a few micrometres over 1 to 4 mm
};

/// Steps, saw teeth, Gaussian, noise, burrs, honed, turned and spikes in turn, each different.
inline NamedScan random_scan(std::mt19937_64& random, int which, rough::Index least, rough::Index most) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    const rough::Index n = std::uniform_int_distribution<rough::Index>(least, most)(random);
    NamedScan scan{"", {Eigen::VectorXd::Zero(n), (1 + 3 * uniform(random)) / static_cast<double>(n)}};
    Eigen::VectorXd& z = scan.profile.heights;
    const double period = static_cast<double>(n) / (3 + 20 * uniform(random)), phase = uniform(random);
    const auto cycle = [&](rough::Index i) { // 0 to 1 within a period
        const double place = static_cast<double>(i) / period + phase;
        return place - std::floor(place);
    };
    const auto smooth_noise = [&](double memory) {
        double value = 0;
        for (rough::Index i = 0; i < n; ++i) {
            value = memory * value + std::sqrt(1 - memory * memory) * normal(random);
            z[i] += value;
        }
    };
    const auto single_nodes = [&](int count, double sign) {
        for (int k = 0; k < count; ++k)
            z[std::uniform_int_distribution<rough::Index>(0, n - 1)(random)] += sign * (1 + 5 * uniform(random));
    };
    const auto at_each = [&](auto height) {
        for (rough::Index i = 0; i < n; ++i) z[i] = height(cycle(i));
    };
    scan.kind = std::array{
        "steps", "saw", "Gaussian", "noise", "burrs", "honed", "turned", "spikes"}[static_cast<unsigned>(which) % 8];
    switch (which % 8) {
    case 0:
        at_each([&](double place) { return (place < 0.3) + 0.01 * normal(random); });
        break;
    case 1:
        at_each([&](double place) { return place + 0.01 * normal(random); });
        break;
    case 2:
        smooth_noise(1 - 20 / static_cast<double>(n));
        break;
    case 3:
        smooth_noise(0);
        break;
    case 4:
        at_each([](double place) { return std::abs(std::cos(3.14159265358979 * place)); });
        single_nodes(4, 1);
        break;
    case 5:
        smooth_noise(0.9);
        z = z.cwiseMin(0.3);
        single_nodes(10, -1);
        break;
    case 6:
        at_each([&](double place) { return 4 * std::pow(place - 0.5, 2) + 0.03 * normal(random); });
        break;
    default:
        smooth_noise(0.99);
        single_nodes(3, 3);
    }
    z *= 1e-3;
    return scan;
}

} // namespace rough::testing
