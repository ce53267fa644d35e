#pragma once

#include "ga/pipeline/parameters.hpp"
#include "ga/problem/problem.hpp"

#include <Eigen/Core>

namespace ga {

/// Residuals r_k of an objective and their derivatives with respect to the genes. For a perfect genome all
/// residuals are 0.
struct Sensitivity {
    Eigen::VectorXd residuals; ///< residuals r, one per point of the objective
    Eigen::MatrixXd jacobian;  ///< dr/dgenes, rows as in r, one column per gene
};

/// The search space around one genome: a box of n variables and functions of a point x in it. Each call
/// counts as an evaluation. `exhausted` is true when the evaluations are spent or the run must stop.
struct Landscape {
    Eigen::VectorXd start; ///< start point, n values inside the box
    Eigen::VectorXd lower; ///< lower bounds, n values
    Eigen::VectorXd upper; ///< upper bounds, n values greater than those of `lower`

    /// Returns the fitness at x; higher is better. It is minus infinity if the evaluation fails or a
    /// constraint is violated.
    std::function<double(const Eigen::VectorXd&)> fitness;
    /// Returns two results at x. The first is the fitness without regard to constraints; higher is better.
    /// The second has one violation per constraint, above 0 if the constraint is violated. If the evaluation
    /// fails, they are minus infinity and an empty vector. Without constraints the function is empty.
    std::function<std::pair<double, Eigen::VectorXd>(const Eigen::VectorXd&)> constrained;
    /// Returns the gradient of the fitness at x, or an empty vector if the evaluation fails. If the problem
    /// has no gradient, the function is empty.
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> gradient;
    /// Returns the residuals and their n derivatives at x, or nothing if the evaluation fails. If the problem
    /// has no residuals, the function is empty.
    std::function<std::optional<Sensitivity>(const Eigen::VectorXd&)> sensitivity;
    std::function<bool()> exhausted; ///< whether to stop at once
    std::uint64_t seed = 0;          ///< for methods that draw random numbers
};

/// A method of refinement. It returns the best point that it finds in a landscape.
struct Method {
    std::string text;                                         ///< text of the method, e.g. "lm 30"
    std::function<Eigen::VectorXd(const Landscape&)> improve; ///< returns the best point found in the box
    bool needs_gradient = false;                              ///< whether it needs the gradient of the fitness
};

/// A method that works on residuals, from the problem's `sensitivity`.
struct ResidualMethod : Method {};

/// Makes a method for `refine` from an object that describes itself and has `improve(landscape)`, after
/// checking its values. It works on residuals if it has `static constexpr bool on_residuals = true`.
template <Described V>
auto method_of(V values) {
    using M = std::conditional_t<V::on_residuals, ResidualMethod, Method>;
    M method;
    check_values(values, "refine " + V::words().name);
    method.text = text_of(values);
    if constexpr (requires { values.needs_gradient(); }) method.needs_gradient = values.needs_gradient();
    method.improve = [values = std::move(values)](const Landscape& land) { return values.improve(land); };
    return method;
}

/// The best point of a search: the smallest violation, then the greatest merit.
struct BestPoint {
    Eigen::VectorXd x;           ///< the point; empty before the first offer
    double merit = -HUGE_VAL;    ///< merit of the point; -HUGE_VAL before the first offer
    double violation = HUGE_VAL; ///< violation of the point, summed over the constraints

    /// Stores the point if it is better than the stored one.
    void offer(const Eigen::VectorXd& point, double value, double violated = 0) {
        if (value > -HUGE_VAL && std::pair(violated, -value) < std::pair(violation, -merit)) {
            x = point;
            merit = value;
            violation = violated;
        }
    }
};

/// The parameter that every method has.
inline Parameter evaluations_parameter() {
    return whole("evaluations", std::nullopt, 1, "at most, after the start").up_to(1e8);
}

} // namespace ga
