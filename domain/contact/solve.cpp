#include "domain/contact/solve.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/active_set.hpp"
#include "domain/contact/solvers/capped.hpp"
#include "domain/contact/solvers/choice.hpp"
#include "domain/contact/solvers/nested.hpp"
#include "domain/contact/solvers/nnls.hpp"
#include "domain/contact/solvers/polonsky_keer.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

void solve_by(Solver solver, const ContactProblem& problem, const ContactOptions& options,
              Solution& solution) {
    switch (solver) {
    case Solver::nnls:
        solution = solve_nnls(problem, options);
        break;
    case Solver::polonsky_keer:
        solution = solve_polonsky_keer(problem, options);
        break;
    case Solver::active_set:
        solve_active_set(problem, options, solution);
        break;
    default:
        expect_factor_to_fit(problem, options);
        solution = solve_nested(problem, options);
    }
}

/// The solver chosen goes first; where it fails, the other one goes on with the step that it failed at.
void solve_by_choice(SolverChoice& choice, ContactProblem problem, const ContactOptions& options,
                     Solution& solution) {
    const auto solve_rest = [&](Solver solver, double most_work) {
        if (solver == Solver::nested)
            solve_nested(problem, options, most_work, solution);
        else
            solve_active_set(problem, options, solution);
    };
    std::string failure;
    try {
        solve_rest(choice.solver, most_nested_work(problem));
        return;
    } catch (const NotConverged& error) {
        failure = error.what();
    } catch (const InputError& error) { // a factor that grows beyond the memory
        failure = error.what();
    }
    check_stop(options);
    const auto solved = static_cast<std::ptrdiff_t>(solution.steps.size());
    problem.approach.erase(problem.approach.begin(), problem.approach.begin() + solved);
    choice.solver = choice.solver == Solver::nested ? Solver::active_set : Solver::nested;
    choice.reason += "; after " + std::to_string(solved) + " load steps handed over to " +
                     (choice.solver == Solver::nested ? "nested" : "active-set") + ": " + failure;
    try {
        solve_rest(choice.solver, std::numeric_limits<double>::infinity());
    } catch (const InputError& error) {
        throw NotConverged(failure + "; " + error.what());
    } catch (const NotConverged& error) {
        check_stop(options);
        throw NotConverged(failure + "; " + error.what());
    }
}

/// The steps without approach, then those with.
Solution solve(SolverChoice& choice, ContactProblem problem, const ContactOptions& options) {
    const auto loaded = std::upper_bound(problem.approach.begin(), problem.approach.end(), 0.0);
    const std::vector<StepSolution> touches(
        static_cast<std::size_t>(loaded - problem.approach.begin()),
        loaded == problem.approach.begin() ? StepSolution() : first_touch(problem, options));
    problem.approach.erase(problem.approach.begin(), loaded);
    Solution solution;
    if (std::isfinite(problem.cap))
        solution = solve_capped(problem, options);
    else if (options.solver == Solver::automatic)
        solve_by_choice(choice, problem, options, solution);
    else
        solve_by(choice.solver, problem, options, solution);
    solution.steps.insert(solution.steps.begin(), touches.begin(), touches.end());
    return solution;
}

void check_solver(const Body& body, const ContactOptions& options) {
    if (body.yields() && options.solver != Solver::automatic && options.solver != Solver::active_set)
        refuse("a hardness was given with a solver that knows none, auto or active-set is expected");
}

void check_tolerance(const ContactOptions& options) {
    if (!(options.tolerance >= 1e-10 && options.tolerance <= 0.01))
        refuse("solver tolerance ", options.tolerance, " was given, one between 1e-10 and 0.01 is expected");
}

/// How well a mean pressure is met, over itself: as well as an iterative solver knows it, else to rounding.
double load_tolerance(Solver solver, const Body& body, const ContactOptions& options) {
    return body.yields() ? 1e-12 : solver == Solver::active_set ? options.tolerance : 0;
}

/// The step at which the mean pressure is `pressure`, from one under less. Newton's method on a convex
/// piecewise linear function reaches it in a finite number of steps, from above after the first. What would
/// leave the bracket is halved instead, and so is a step from above that gained little: with a hardness
/// P(Delta) only never falls, and in full contact a periodic half-plane's stiffness is rounding alone.
LoadStep pressed_to(double pressure, const Profile& profile, const Body& body, const ContactOptions& options,
                    LoadStep from) {
    constexpr double met = 1e-9, little = 0.75;
    const double highest = largest_displacement(profile, body);
    double below = from.displacement, above = body.yields() ? highest : HUGE_VAL;
    if (from.pressure > pressure) // by no more than the solver's tolerance
        below = 0, above = from.displacement;
    bool halve = false;
    for (int k = 0; k < 200; ++k) {
        const double missing = std::abs(pressure - from.pressure);
        double next = from.displacement + (pressure - from.pressure) / from.tangent_stiffness;
        if (std::abs(next - from.displacement) <= 1e-15 * next && missing <= met * pressure) {
            from.displacement = std::min(next, highest);
            return from;
        }
        if (halve || !(next > below && next < above))
            next = std::isfinite(above) ? 0.5 * (below + above) : 2 * from.displacement;
        next = std::min(next, highest);
        const bool from_above = from.pressure > pressure;
        const ContactCurve curve = solve_contact(profile, body, {next}, options);
        from = curve.steps.front();
        if (next == highest && from.pressure < pressure * (1 - 1e-12))
            refuse("mean pressure ", pressure, " MPa was given, at most that of full contact, ",
                   from.pressure, " MPa, is expected");
        const double left = std::abs(pressure - from.pressure);
        if (left <= load_tolerance(curve.solver, body, options) * pressure)
            return from;
        (from.pressure < pressure ? below : above) = next;
        halve = from_above && from.pressure > pressure && left > little * missing;
    }
    throw NotConverged(line_of("no displacement was found for the mean pressure ", pressure,
                               " MPa; that of the last one tried was ", from.pressure, " MPa"));
}

/// Every node at the hardness.
void check_bearable(double pressure, const Profile& profile, const Body& body) {
    const double most = body.hardness * static_cast<double>(profile.nodes()) / elements(profile, body.kernel);
    if (!(pressure < most))
        refuse("mean pressure ", pressure, " MPa was given, less than what all nodes bear at the hardness, ",
               most, " MPa, is expected");
}

/// Under load control the active set goes on from step to step on an area, where one solution costs much.
bool takes_loads(const Profile& profile, const Body& body, const ContactOptions& options) {
    return profile.is_area() && profile.nodes() > always_nested && !body.yields() &&
           (options.solver == Solver::automatic || options.solver == Solver::active_set);
}

/// From the mean pressure on at which no node of a periodic surface is under tension all touch: p = P + H^-1
/// Z.
void check_full_contact(double pressure, const Profile& profile, const Body& body) {
    if (body.kernel != Kernel::periodic)
        return;
    const ContactProblem problem = make_problem(profile, body, {});
    const Eigen::ArrayXd spectrum = spectrum_on(problem, problem.shape);
    FourierOperator inverse =
        FourierOperator::circulant(problem.shape, (spectrum > 0).select(1 / spectrum, 0).matrix());
    Eigen::VectorXd::Map(inverse.input(), problem.nodes()) = -problem.gap;
    const double most =
        -Eigen::VectorXd::Map(inverse.apply(), problem.nodes()).minCoeff() * problem.pressure_unit;
    if (pressure > most)
        refuse("mean pressure ", pressure, " MPa was given, at most that of full contact, ", most,
               " MPa, is expected");
}

/// By a solver that takes loads.
template <class SolveLoads>
ContactCurve solved_at(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                       const ContactOptions& options, SolveLoads solve_loads) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    ContactProblem problem =
        make_problem(profile, body, {std::min(range > 0 ? range : 1, largest_displacement(profile, body))});
    std::vector<double> loads, displacements;
    for (const double pressure : pressures)
        loads.push_back(pressure / problem.pressure_unit * problem.elements);
    Solution solution = solve_loads(problem, loads, options);
    for (const double approach : problem.approach)
        displacements.push_back(approach * problem.displacement_unit);
    return in_units(problem, displacements, std::move(solution), options.states);
}

} // namespace

ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options) {
    check_tolerance(options);
    check_solver(body, options);
    const ContactProblem problem = make_problem(profile, body, displacements);
    SolverChoice choice = options.solver == Solver::automatic ? choose_solver(problem, options)
                                                              : SolverChoice{options.solver, "asked for"};
    ContactCurve curve = in_units(problem, displacements, solve(choice, problem, options), options.states);
    curve.solver = choice.solver;
    curve.choice = choice.reason;
    return curve;
}

ContactCurve solve_contact_at_pressures(const Profile& profile, const Body& body,
                                        const std::vector<double>& pressures, const ContactOptions& options) {
    check_tolerance(options);
    check_solver(body, options);
    make_problem(profile, body, {});
    double previous = 0;
    for (const double pressure : pressures) {
        if (!std::isfinite(pressure) || !(pressure > previous))
            refuse("mean pressure ", pressure, " MPa was given after ", previous,
                   " MPa, positive increasing finite values are expected");
        check_bearable(pressure, profile, body);
        previous = pressure;
    }
    ContactCurve curve;
    if (options.solver == Solver::polonsky_keer) {
        curve = solved_at(profile, body, pressures, options, solve_polonsky_keer_loads);
        curve.solver = Solver::polonsky_keer;
    } else if (takes_loads(profile, body, options)) {
        check_full_contact(pressures.back(), profile, body);
        curve = solved_at(profile, body, pressures, options, solve_active_set_loads);
        curve.solver = Solver::active_set;
        curve.choice = "active-set: it takes loads on an area";
    } else {
        LoadStep from = solve_contact(profile, body, {0}, options).steps.front();
        std::vector<double> displacements;
        for (const double pressure : pressures) {
            from = pressed_to(pressure, profile, body, options, from);
            displacements.push_back(from.displacement);
        }
        curve = solve_contact(profile, body, displacements, options);
    }
    return curve;
}

} // namespace rough
