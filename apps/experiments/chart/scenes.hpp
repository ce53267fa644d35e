#pragma once

#include "domain/contact/solve.hpp"

#include <functional>
#include <string>

namespace app {

/// A curve so fine that other curves are measured against it: between its points it is linear.
struct ChartTruth {
    Eigen::VectorXd displacement;     ///< mm, increasing from 0
    Eigen::VectorXd pressure;         ///< MPa
    Eigen::VectorXd stiffness;        ///< tangent, MPa/mm
    Eigen::VectorXd fraction;         ///< of the length in contact
    std::string origin;               ///< "the exact solution", or how far it was refined
    rough::Index finest_verified = 0; ///< grids of more nodes are too close to it to be verified by it
};

/// A profile known everywhere, to be sampled on any grid and pressed to a last displacement.
struct ChartScene {
    std::string name;
    std::string words; ///< what it is
    rough::Body body;
    double length = 1; ///< mm
    std::function<double(double)> height;
    double last = 0;                   ///< mm
    std::function<ChartTruth()> exact; ///< where there is an exact solution

    rough::Profile profile(rough::Index nodes) const;
    std::vector<double> displacements(int steps) const;
};

/// hertz, westergaard, mwm-smooth, mwm-rough and fractional-brownian.
std::vector<ChartScene> chart_scenes();

/// The exact curve, or that of ever finer grids (four times the nodes, at most `most_nodes`) until pressures
/// move by less than 1e-6 of themselves (root mean square). Throws rough::NotConverged when `stop` says so.
ChartTruth truth_of(const ChartScene& scene, rough::Index most_nodes, const std::function<bool()>& stop = {});

} // namespace app
