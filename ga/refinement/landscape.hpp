#pragma once

#include "ga/problem.hpp"

#include <cstdint>
#include <optional>

namespace ga {

/// One genome's surroundings as an optimiser sees them: a box of n variables and functions of a point x in
/// it. Each call is paid and counted; when the evaluations are spent or the run must stop, `exhausted` is
/// true.
struct Landscape {
    Eigen::VectorXd start; ///< n, inside the box
    Eigen::VectorXd lower; ///< n
    Eigen::VectorXd upper; ///< n, greater than `lower`

    /// Fitness at x; minus infinity when the evaluation fails.
    std::function<double(const Eigen::VectorXd&)> fitness;
    /// Gradient of the fitness at x; empty where the problem has none, of size zero when the evaluation
    /// fails.
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> gradient;
    /// Residuals and their n columns at x; empty where the problem has none, nothing when the evaluation
    /// fails.
    std::function<std::optional<Sensitivity>(const Eigen::VectorXd&)> sensitivity;
    std::function<bool()> exhausted; ///< whether to stop at once
    std::uint64_t seed = 0;          ///< for methods that draw random numbers
};

/// How refinement moves a genome: from a landscape to the best point it found.
struct Method {
    std::string text;                                         ///< "gcmma 5"
    std::function<Eigen::VectorXd(const Landscape&)> improve; ///< gives the best point it found in the box
    bool needs_gradient = false;                              ///< of the fitness or of residuals
};

/// A method that works on residuals: it asks the problem for `sensitivity`.
struct ResidualMethod : Method {};

} // namespace ga
