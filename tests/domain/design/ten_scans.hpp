#pragma once

#include "domain/mwm/test_surfaces.hpp"
#include "domain/profile/detrend.hpp"
#include "ga/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// Ten surfaces as a stylus would measure them, two of each kind.
namespace ten_scans {

using rough::Index;

struct Scan {
    std::string name;
    rough::Profile profile;
};

inline const rough::Grid grid{1024, 4, false}; ///< 4 mm

/// Normal heights smoothed over `correlation` (mm), rms 1.
inline Eigen::VectorXd smoothed(double correlation, ga::Stream random) {
    const double h = grid.spacing();
    const auto reach = static_cast<Index>(3 * correlation / h);
    Eigen::VectorXd noise(grid.nodes + 2 * reach), z = Eigen::VectorXd::Zero(grid.nodes);
    for (double& one : noise)
        one = random.normal();
    for (Index j = -reach; j <= reach; ++j) {
        const double t = static_cast<double>(j) * h / correlation;
        z += std::exp(-t * t) * noise.segment(reach + j, grid.nodes);
    }
    return z / std::sqrt(z.squaredNorm() / static_cast<double>(grid.nodes));
}

/// Grooves of a round tool, `feed` apart, with what the cut leaves on them.
inline rough::Profile turned(double feed, double rest, std::uint64_t seed) {
    Eigen::VectorXd z = rest * smoothed(0.02, ga::Stream(seed));
    for (Index i = 0; i < grid.nodes; ++i) {
        const double x = grid.spacing() * static_cast<double>(i) / feed, t = x - std::floor(x) - 0.5;
        z[i] += 4e-3 * 4 * t * t;
    }
    return {z, grid.spacing()};
}

inline rough::Profile ground(double correlation, std::uint64_t seed) {
    const Eigen::VectorXd coarse = smoothed(correlation, ga::Stream(seed)),
                          fine = smoothed(0.1 * correlation + 0.005, ga::Stream(seed + 100));
    return {1e-3 * (0.8 * coarse + 0.3 * fine), grid.spacing()};
}

/// Plateaux with grooves cut across them.
inline rough::Profile honed(int grooves, std::uint64_t seed) {
    ga::Stream random(seed);
    Eigen::VectorXd z = 2e-4 * smoothed(0.03, ga::Stream(seed + 100));
    for (int g = 0; g < grooves; ++g) {
        const double at = random.uniform(0, grid.length), width = random.uniform(0.02, 0.08),
                     depth = random.uniform(1e-3, 4e-3);
        for (Index i = 0; i < grid.nodes; ++i)
            z[i] -= depth * std::max(0.0, 1 - std::abs(grid.spacing() * static_cast<double>(i) - at) / width);
    }
    return {z, grid.spacing()};
}

inline rough::Profile walk(std::uint64_t seed) {
    ga::Stream random(seed);
    Eigen::VectorXd z(grid.nodes);
    double height = 0;
    for (double& one : z)
        one = height += 1e-4 * random.normal();
    return {rough::detrended({z, grid.spacing()}, rough::Detrend::line), grid.spacing()};
}

inline std::vector<Scan> all() {
    return {{"turned, feed 0.33 mm", turned(0.33, 2e-4, 1)},
            {"turned, feed 0.125 mm", turned(0.125, 4e-4, 2)},
            {"ground, fine", ground(0.03, 3)},
            {"ground, coarse", ground(0.1, 4)},
            {"fractured, H = 0.8", rough::fractal_profile(grid, 0.8, 1e-3, 5)},
            {"fractured, H = 0.6", rough::fractal_profile(grid, 0.6, 1e-3, 6)},
            {"honed, 15 grooves", honed(15, 7)},
            {"honed, 40 grooves", honed(40, 8)},
            {"random walk, first", walk(9)},
            {"random walk, second", walk(10)}};
}

} // namespace ten_scans
