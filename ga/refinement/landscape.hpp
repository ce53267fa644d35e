#pragma once

#include "ga/pipeline/parameters.hpp"
#include "ga/refinement/sensitivity.hpp"

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

    /// Fitness at x, turned so that greater is better; minus infinity where the evaluation fails or a
    /// constraint is violated.
    std::function<double(const Eigen::VectorXd&)> fitness;
    /// Fitness at x whatever the constraints, turned so that greater is better, and one violation per
    /// constraint, above 0 if it is violated; minus infinity and of size zero where the evaluation fails.
    /// Empty where the problem has no constraint.
    std::function<std::pair<double, Eigen::VectorXd>(const Eigen::VectorXd&)> constrained;
    /// Gradient of that fitness at x; empty where the problem has none, of size zero when the evaluation
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
    std::string text;                                         ///< "lm 30"
    std::function<Eigen::VectorXd(const Landscape&)> improve; ///< gives the best point it found in the box
    bool needs_gradient = false;                              ///< of the fitness
};

/// A method that works on residuals: it asks the problem for `sensitivity`.
struct ResidualMethod : Method {};

/// A method's values, checked, as the method that `refine` takes. The values say what they are (Described),
/// improve a landscape, and work on residuals where they have `static constexpr bool on_residuals = true`.
template <Described V>
auto method_of(V values) {
    using M = std::conditional_t<V::on_residuals, ResidualMethod, Method>;
    M method;
    check_values(values, "refine " + V::words().name);
    if constexpr (requires { values.validate(); })
        values.validate();
    method.text = text_of(values);
    if constexpr (requires { values.needs_gradient(); })
        method.needs_gradient = values.needs_gradient();
    method.improve = [values = std::move(values)](const Landscape& land) { return values.improve(land); };
    return method;
}

/// The best point a search has seen: of the smallest violation, and of these of the greatest merit.
struct BestPoint {
    Eigen::VectorXd x;           ///< none before the first offer
    double merit = -HUGE_VAL;    ///< of x; -HUGE_VAL before the first offer
    double violation = HUGE_VAL; ///< of x, summed over the constraints; 0 if there is none

    /// Takes the point where it is better; of equal ones the first.
    void offer(const Eigen::VectorXd& point, double value, double violated = 0) {
        if (value > -HUGE_VAL && std::pair(violated, -value) < std::pair(violation, -merit)) {
            x = point;
            merit = value;
            violation = violated;
        }
    }
};

/// The parameter of a method that every one has.
inline Parameter evaluations_parameter(std::optional<std::string> standard = std::nullopt) {
    return whole("evaluations", std::move(standard), 1, "at most, after the start").up_to(1e8);
}

} // namespace ga
