#include "domain/contact/solve.hpp"

#include "domain/contact/solvers/active_set.hpp"
#include "domain/contact/solvers/choice.hpp"
#include "domain/contact/solvers/nested.hpp"
#include "domain/contact/solvers/nnls.hpp"
#include "domain/contact/solvers/polonsky_keer.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

ContactCurve in_units(const ContactProblem& problem, const std::vector<double>& displacements,
                      Solution solution, bool states) {
    ContactCurve curve;
    curve.iterations = solution.iterations;
    for (std::size_t j = 0; j < solution.steps.size(); ++j) {
        StepSolution& found = solution.steps[j];
        curve.steps.push_back(load_step(problem, displacements[j], found));
        if (states) {
            // w = H_AA^-1 1 in MPa/mm, so that dP/dDelta = (delta/L) sum w
            const double tangent_unit = problem.stiffness_unit * problem.elements;
            curve.states.push_back({std::move(found.nodes), found.pressure * problem.pressure_unit,
                                    found.tangent * tangent_unit});
        }
    }
    return curve;
}

/// First touch: no pressure yet, and the stiffness of the nodes that touch.
StepSolution first_touch(const ContactProblem& problem, const ContactOptions& options) {
    ContactSet touching(problem.nodes());
    for (Index i = 0; i < problem.nodes(); ++i)
        if (problem.gap[i] == 0)
            touching.insert(i);
    touching.collect();
    Loaded load(problem.nodes()), tangent(problem.nodes());
    SetSolver(problem).tangent(touching, 1e-10, true, tangent);
    return step_solution(touching, load, tangent, options.states);
}

Solution solve_by(Solver solver, const ContactProblem& problem, const ContactOptions& options) {
    switch (solver) {
    case Solver::nnls:
        return solve_nnls(problem, options);
    case Solver::polonsky_keer:
        return solve_polonsky_keer(problem, options);
    case Solver::active_set:
        return solve_active_set(problem, options);
    default:
        expect_factor_to_fit(problem, options);
        return solve_nested(problem, options);
    }
}

/// The steps without approach, then those with.
Solution solve(Solver solver, ContactProblem problem, const ContactOptions& options) {
    const auto loaded = std::upper_bound(problem.approach.begin(), problem.approach.end(), 0.0);
    const std::vector<StepSolution> touches(
        static_cast<std::size_t>(loaded - problem.approach.begin()),
        loaded == problem.approach.begin() ? StepSolution() : first_touch(problem, options));
    problem.approach.erase(problem.approach.begin(), loaded);
    Solution solution = solve_by(solver, problem, options);
    solution.steps.insert(solution.steps.begin(), touches.begin(), touches.end());
    return solution;
}

void check_tolerance(const ContactOptions& options) {
    if (!(options.tolerance >= 1e-10 && options.tolerance <= 0.01))
        refuse("solver tolerance ", options.tolerance, " was given, one between 1e-10 and 0.01 is expected");
}

/// The displacement (mm) at which the mean pressure is `pressure`: Newton's method on a convex piecewise
/// linear function reaches it in a finite number of steps, from above after the first.
double displacement_at(double pressure, const Profile& profile, const Body& body,
                       const ContactOptions& options, LoadStep from) {
    const double highest = largest_displacement(profile, body);
    for (int k = 0; k < 100; ++k) {
        const double next = std::min(
            highest, std::max(0.0, from.displacement + (pressure - from.pressure) / from.tangent_stiffness));
        if (std::abs(next - from.displacement) <= 1e-15 * next)
            return next;
        from = solve_contact(profile, body, {next}, options).steps.front();
        if (next == highest && from.pressure < pressure * (1 - 1e-12))
            refuse("mean pressure ", pressure, " MPa was given, at most that of full contact, ",
                   from.pressure, " MPa, is expected");
    }
    return from.displacement;
}

ContactCurve polonsky_keer_at(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                              const ContactOptions& options) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    ContactProblem problem =
        make_problem(profile, body, {std::min(range > 0 ? range : 1, largest_displacement(profile, body))});
    std::vector<double> loads, displacements;
    for (const double pressure : pressures)
        loads.push_back(pressure / problem.pressure_unit * problem.elements);
    Solution solution = solve_polonsky_keer_loads(problem, loads, options);
    for (const double approach : problem.approach)
        displacements.push_back(approach * problem.displacement_unit);
    return in_units(problem, displacements, std::move(solution), options.states);
}

} // namespace

ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options) {
    check_tolerance(options);
    const ContactProblem problem = make_problem(profile, body, displacements);
    const SolverChoice choice = options.solver == Solver::automatic
                                    ? choose_solver(problem, options)
                                    : SolverChoice{options.solver, "asked for"};
    ContactCurve curve =
        in_units(problem, displacements, solve(choice.solver, problem, options), options.states);
    curve.solver = choice.solver;
    curve.choice = choice.reason;
    return curve;
}

ContactCurve solve_contact_at_pressures(const Profile& profile, const Body& body,
                                        const std::vector<double>& pressures, const ContactOptions& options) {
    check_tolerance(options);
    make_problem(profile, body, {});
    double previous = 0;
    for (const double pressure : pressures) {
        if (!std::isfinite(pressure) || !(pressure > previous))
            refuse("mean pressure ", pressure, " MPa was given after ", previous,
                   " MPa, positive increasing finite values are expected");
        previous = pressure;
    }
    ContactCurve curve;
    if (options.solver == Solver::polonsky_keer) {
        curve = polonsky_keer_at(profile, body, pressures, options);
        curve.solver = Solver::polonsky_keer;
    } else {
        LoadStep from = solve_contact(profile, body, {0}, options).steps.front();
        std::vector<double> displacements;
        for (const double pressure : pressures) {
            displacements.push_back(displacement_at(pressure, profile, body, options, from));
            from = solve_contact(profile, body, {displacements.back()}, options).steps.front();
        }
        curve = solve_contact(profile, body, displacements, options);
    }
    return curve;
}

} // namespace rough
