#include "domain/contact/solve.hpp"

#include "domain/contact/interface.hpp"
#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

namespace rough {
namespace {

/// A step in MPa and mm, at this displacement (mm).
LoadStep load_step(const ContactProblem& problem, double displacement, const StepSolution& found) {
    LoadStep step;
    step.displacement = displacement;
    step.pressure = found.pressure.sum() / problem.elements * problem.pressure_unit;
    step.tangent_stiffness = found.stiffness * problem.stiffness_unit;
    step.kkt_residual = found.residual;
    if (!std::isfinite(step.pressure) || !std::isfinite(step.tangent_stiffness))
        refuse("displacement ", displacement, " mm: mean pressure ", step.pressure, " MPa or stiffness ",
               step.tangent_stiffness,
               " MPa/mm is beyond double precision; change the modulus, heights or node spacing");
    step.largest_pressure = found.pressure.size() ? found.pressure.maxCoeff() * problem.pressure_unit : 0;
    step.contact_nodes = static_cast<Index>(found.nodes.size());
    step.held_nodes = found.held;
    step.contact_fraction = static_cast<double>(step.contact_nodes) / static_cast<double>(problem.nodes());
    return step;
}

/// The curve in MPa and mm, at the given displacements (mm) or, under load control, those found.
ContactCurve in_units(const ContactProblem& problem, const std::vector<double>& displacements, Solution solution,
                      Solver solver, const ContactOptions& options) {
    ContactCurve curve;
    curve.solver = solver;
    curve.iterations = solution.iterations;
    if (!solution.steps.empty()) curve.last_contact = solution.steps.back().nodes;
    for (std::size_t j = 0; j < solution.steps.size(); ++j) {
        StepSolution& found = solution.steps[j];
        curve.steps.push_back(load_step(
            problem, problem.load.empty() ? displacements[j] : found.approach * problem.displacement_unit, found));
        if (options.spots)
            curve.steps.back().spot_width = spot_width(found.nodes, problem.shape, problem.kernel == Kernel::periodic);
        if (options.states) {
            // w = H_AA^-1 1 in MPa/mm, so that dP/dDelta = sum w over L/delta, on a map over N
            const double tangent_unit = problem.stiffness_unit * problem.elements;
            curve.states.push_back(
                {std::move(found.nodes), found.pressure * problem.pressure_unit, found.tangent * tangent_unit});
        }
    }
    return curve;
}

/// First touch: no pressure yet, and the stiffness of the nodes that touch.
StepSolution first_touch(const ContactProblem& problem, const ContactOptions& options) {
    ContactSet touching(problem.nodes());
    touching.assign([&](Index i) { return problem.gap[i] == 0; });
    SurfaceState load(problem.nodes()), tangent(problem.nodes());
    SetSolver(problem).tangent(touching, 1e-10, true, tangent);
    return step_solution(touching, load, tangent, options.states);
}

/// Whether the solver presses to loads directly. If not, Newton's method finds the displacements.
bool takes_loads(Solver solver, const ContactProblem& problem) {
    const auto loads = row_of(solver).loads;
    return problem.load.empty() ||
           (!std::isfinite(problem.cap) &&
            (loads == ContactSolver::always || (loads == ContactSolver::on_maps && problem.is_2d())));
}

/// Solves the loads of a problem that a solver does not take, by Newton's method.
using Newton = std::function<void(Solver, Solution&)>;

void solve_with(Solver solver, const ContactProblem& problem, const ContactOptions& options, const Newton& newton,
                Solution& solution) {
    takes_loads(solver, problem) ? row_of(solver).solve(problem, options, solution) : newton(solver, solution);
}

/// `chosen` goes first and becomes the solver used last. If it fails, every other one continues in turn with
/// the failed step. Each has a limit: factors of memory and work, iterative solvers of iterations. A factor
/// that was chosen gives up early, and is tried a second time after the active set.
void solve_by_choice(Solver& chosen, ContactProblem& problem, const ContactOptions& options, const Newton& newton,
                     Solution& solution) {
    std::vector<Solver> order{chosen};
    for (const Solver solver : {Solver::active_set, Solver::nested, Solver::polonsky_keer, Solver::nnls})
        if (solver != chosen || (solver == Solver::nested && problem.nodes() > always_nested)) order.push_back(solver);
    problem.work_limit = max_nested_work(problem);
    std::vector<double>& steps = problem.load.empty() ? problem.approach : problem.load;
    std::string failures;
    for (const Solver solver : order) {
        const std::size_t solved = solution.steps.size();
        chosen = solver;
        try {
            return solve_with(solver, problem, options, newton, solution);
        } catch (const NotConverged& error) {
            failures += (failures.empty() ? "" : "; ") + std::string(error.what());
        } catch (const InputError& error) { // a factor that grows beyond the memory
            failures += (failures.empty() ? "" : "; ") + std::string(error.what());
        }
        check_stop(options);
        problem.work_limit = 5e10; // multiplications of a factor, which take some seconds
        steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(solution.steps.size() - solved));
    }
    throw NotConverged(failures);
}

/// The steps at zero displacement, then the loaded ones. Solved steps are taken out of the problem.
Solution solve(Solver& chosen, ContactProblem& problem, const ContactOptions& options, const Newton& newton = {}) {
    const auto loaded = std::upper_bound(problem.approach.begin(), problem.approach.end(), 0.0);
    const std::vector<StepSolution> touches(static_cast<std::size_t>(loaded - problem.approach.begin()),
                                            loaded == problem.approach.begin() ? StepSolution()
                                                                               : first_touch(problem, options));
    problem.approach.erase(problem.approach.begin(), loaded);
    Solution solution;
    if (std::isfinite(problem.cap) && problem.load.empty())
        solve_capped(problem, options, solution);
    else if (options.solver == Solver::automatic && !std::isfinite(problem.cap))
        solve_by_choice(chosen, problem, options, newton, solution);
    else {
        if (chosen == Solver::nested) expect_factor_to_fit(problem, options);
        solve_with(chosen, problem, options, newton, solution);
    }
    solution.steps.insert(solution.steps.begin(), touches.begin(), touches.end());
    return solution;
}

void check_options(const Body& body, const ContactOptions& options) {
    if (!(options.tolerance >= 1e-10 && options.tolerance <= 0.01))
        refuse("solver tolerance: ", options.tolerance, " is out of range (1e-10 to 0.01)");
    if (body.yields() && !row_of(options.solver).capped)
        refuse("solver: ", name_of(options.solver), " cannot hold a hardness; choose auto or active-set");
}

[[noreturn]] void refuse_beyond_full_contact(double pressure, double full) {
    refuse("mean pressure: ", pressure, " MPa is above that of full contact; give at most ", full, " MPa");
}

/// The load step at which the mean pressure is `pressure`, starting from one with less. Newton's method on a
/// convex piecewise linear function reaches it in a finite number of steps, from above after the first. The
/// bracket is halved if a step would leave it, or if a step from above gained little. P(Delta) is convex if
/// contact sets only grow, but need not be with a hardness or layers. At the pressure `full` of full contact
/// a periodic half-plane is singular. A step beyond it ends halfway to it, near it on the chord to it.
LoadStep pressed_to(double pressure, double full, const Profile& profile, const Body& body,
                    const ContactOptions& options, LoadStep from) {
    constexpr double met = 1e-9, little = 0.75;
    // With a hardness the solver finds gaps to 1e-11. A bracket narrower than this share of the displacement
    // does not tell pressures apart, and a pressure with this relative error is accepted.
    constexpr double narrowest = 1e-10, met_there = 1e-8;
    const double highest = largest_displacement(profile, body);
    double below = from.displacement, above = HUGE_VAL;
    if (from.pressure > pressure) // at most by the solver's tolerance
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
        if (next >= highest)
            next = from.displacement < 0.999 * highest
                       ? 0.5 * (from.displacement + highest)
                       : highest - (highest - from.displacement) * (full - pressure) / (full - from.pressure);
        const bool from_above = from.pressure > pressure;
        const ContactCurve curve = solve_contact(profile, body, {next}, options);
        from = curve.steps.front();
        if (next == highest && from.pressure < pressure * (1 - 1e-12))
            refuse_beyond_full_contact(pressure, from.pressure);
        const double left = std::abs(pressure - from.pressure);
        // Half the tolerance of an iterative solver, otherwise rounding.
        const double tolerance = is_direct(curve.solver) ? 0 : 0.5 * options.tolerance;
        if (left <= (body.yields() ? 1e-12 : tolerance) * pressure) return from;
        (from.pressure < pressure ? below : above) = next;
        if (body.yields() && above - below <= narrowest * above && left <= met_there * pressure) return from;
        halve = from_above && from.pressure > pressure && left > little * missing;
    }
    throw NotConverged(line_of("no displacement was found for the mean pressure ", pressure,
                               " MPa; the last one tried gave ", from.pressure, " MPa"));
}

/// The state of full contact under a load, if none of its nodes is under tension or at the hardness. Every such load
/// has the same displacement. K is that of all nodes except the least loaded one, as just below full contact.
std::optional<StepSolution> pressed_flat(double load, const ContactProblem& problem, const ContactOptions& options) {
    SurfaceState state(problem.nodes()), tangent(problem.nodes());
    state.pressure = full_contact_pressure(problem).array() + load / static_cast<double>(problem.nodes());
    if (!(state.pressure.maxCoeff() < problem.cap)) return {};
    Index lowest = 0;
    state.pressure.minCoeff(&lowest);
    state.pressure = state.pressure.cwiseMax(0); // below it by rounding
    ContactSet set(problem.nodes());
    set.assign([&](Index i) { return i != lowest; });
    SetSolver(problem).tangent(set, 1e-10, true, tangent);
    const double stiffness = step_solution(set, state, tangent, false).stiffness;
    set.assign([](Index) { return true; });
    StepSolution step = step_solution(set, state, tangent, options.states);
    step.stiffness = stiffness;
    step.approach = problem.gap.mean();
    SplitOperator check(problem.column, problem.shape, *problem.team);
    certify_step("full contact", problem, step, check, state.pressure, HUGE_VAL);
    return step;
}

/// First guess of the first load's displacement, mm: that of every fourth node, or fewer of a fine grid, by
/// the factor. 0 if it is not known.
double first_guess(ContactProblem problem, const ContactOptions& options) {
    constexpr Index fewest = 64, stride = 4, largest = 1024;
    if (problem.nodes() < fewest) return 0;
    Index highest = 0;
    problem.gap.minCoeff(&highest);
    problem.load.resize(1);
    problem.work_limit = unlimited_work;
    try {
        Solution found;
        solve_nested(coarsened(problem, std::max(stride, problem.nodes() / largest), highest), options, found);
        return found.steps[0].approach * problem.displacement_unit;
    } catch (const NotConverged&) { // the coarse grid is in full contact below the load
        check_stop(options);
        return 0;
    }
}

/// Presses to the loads of a problem by a solver that takes displacements; Newton's method finds them.
void solve_by_newton(const ContactProblem& problem, const Profile& profile, const Body& body, double full,
                     const ContactOptions& options, Solution& solution) {
    std::vector<std::optional<StepSolution>> flat;
    std::vector<double> displacements;
    const double highest = largest_displacement(profile, body), guess = first_guess(problem, options);
    LoadStep from = solve_contact(profile, body, {guess < highest ? guess : 0}, options).steps.front();
    for (const double load : problem.load) {
        const double pressure = load / problem.elements * problem.pressure_unit;
        flat.push_back(pressure >= full * (1 - 1e-12) ? pressed_flat(load, problem, options) : std::nullopt);
        if (flat.back()) continue;
        from = pressed_to(pressure, full, profile, body, options, from);
        displacements.push_back(from.displacement);
    }
    ContactProblem found = make_problem(profile, body, displacements, *problem.team);
    Solver solver = choose_solver(found, options);
    const Solution elastic = solve(solver, found, options);
    const double unit = found.displacement_unit / problem.displacement_unit;
    solution.iterations += elastic.iterations;
    for (auto [step, j] = std::pair(elastic.steps.begin(), 0U); j < flat.size(); ++j) {
        solution.steps.push_back(flat[j] ? *flat[j] : *step++);
        if (flat[j]) continue;
        solution.steps.back().approach *= unit;
        solution.steps.back().pressure *= unit;
    }
}

/// The sum of H^-1 1.
double sum_of_tangents(const ContactProblem& problem) {
    constexpr double tolerance = 1e-6; // residual of H w = 1; 2 sum w - w'Hw errs by its square
    ContactSet all(problem.nodes());
    all.assign([](Index) { return true; });
    SurfaceState tangent(problem.nodes());
    SetSolver(problem).tangent(all, tolerance, true, tangent);
    const Eigen::VectorXd image = SplitOperator(problem.column, problem.shape).apply(tangent.pressure);
    const double residual = (image.array() - 1).abs().maxCoeff();
    if (!(residual <= tolerance))
        throw NotConverged(
            line_of("full contact did not converge: residual ", residual, " is above the tolerance ", tolerance));
    return tangent.pressure.dot((2 - image.array()).matrix());
}

/// Body, nodes, rows, and the strip's width or the area's row spacing in units of the spacing.
using Key = std::tuple<Kernel, Index, Index, double>;

/// sum_of_tangents, remembered for all threads.
double known_sum(const Key& key, const ContactProblem& problem) {
    static std::mutex lock;
    static std::map<Key, double> known;
    const std::lock_guard held(lock);
    const auto found = known.find(key);
    return found != known.end() ? found->second : known[key] = sum_of_tangents(problem);
}

} // namespace

const std::vector<std::string>& solver_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const ContactSolver& solver : contact_solvers) all.emplace_back(solver.name);
        return all;
    }();
    return names;
}

const std::string& name_of(Solver solver) { return solver_names()[static_cast<std::size_t>(solver)]; }

bool is_direct(Solver solver) { return row_of(solver).direct; }

ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options) {
    check_options(body, options);
    Team team(useful_threads(profile, options.threads));
    ContactProblem problem = make_problem(profile, body, displacements, team);
    Solver solver = choose_solver(problem, options);
    Solution solution = solve(solver, problem, options);
    return in_units(problem, displacements, std::move(solution), solver, options);
}

ContactCurve solve_contact_at_pressures(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                                        const ContactOptions& options) {
    check_options(body, options);
    Team team(useful_threads(profile, options.threads));
    checked_body(profile, body);
    const double largest = body.hardness * static_cast<double>(profile.nodes()) / elements(profile, body.kernel);
    double previous = 0;
    for (const double pressure : pressures) {
        if (!std::isfinite(pressure) || !(pressure > previous))
            refuse("mean pressure: ", pressure, " MPa after ", previous,
                   " MPa is not a larger finite value; sort the pressures");
        if (!(pressure < largest))
            refuse("mean pressure: ", pressure, " MPa is not below that of all nodes at the hardness; give less than ",
                   largest, " MPa");
        previous = pressure;
    }
    if (pressures.empty()) return {};
    ContactProblem problem = make_problem_at(profile, body, pressures, team);
    const double full = body.relative_to_mean() ? full_contact_load(profile, body) : HUGE_VAL;
    if (!body.yields() && pressures.back() > full) refuse_beyond_full_contact(pressures.back(), full);
    Solver solver = choose_solver(problem, options);
    const auto newton = [&](Solver by, Solution& solution) {
        ContactOptions with = options;
        with.solver = by;
        solve_by_newton(problem, profile, body, full, with, solution);
    };
    Solution solution = solve(solver, problem, options, newton);
    return in_units(problem, {}, std::move(solution), solver, options);
}

double displacement_at_pressure(const Profile& profile, const Body& body, double pressure, ContactOptions options) {
    options.states = false;
    const bool direct =
        options.solver == Solver::automatic ? profile.nodes() <= always_nested : is_direct(options.solver);
    // On a map, and with a hardness, the load is met exactly.
    const double slack = direct || profile.is_2d() || body.yields() ? 0 : 2 * options.tolerance;
    return solve_contact_at_pressures(profile, body, {pressure * (1 + slack)}, options).steps.front().displacement;
}

std::vector<LoadStep> solve_partial_slip(const Profile& profile, const Body& body, double displacement, double friction,
                                         int steps, ContactOptions options) {
    if (profile.is_2d()) refuse("partial slip: the tangential matrix of a map is not known; give a line");
    options.states = true;
    const ContactState normal = solve_contact(profile, body, {displacement}, options).states.front();
    ContactProblem problem = make_problem(profile, body, {displacement});
    problem.traction = Traction::tangential;
    problem.column = influence_column(problem, problem.shape);
    Eigen::VectorXd limit = Eigen::VectorXd::Zero(problem.nodes());
    limit(normal.nodes) = friction / problem.pressure_unit * normal.pressure;
    const Eigen::VectorXd moved = SplitOperator(problem.column, problem.shape).apply(limit);
    const double last = moved(normal.nodes).maxCoeff(); // every node slips
    problem.approach.clear();
    for (int k = 0; k < steps; ++k) problem.approach.push_back(last * k / steps);
    options.states = false;
    Solution solution;
    solve_slip(problem, limit, options, solution);
    StepSolution slipping{.nodes = normal.nodes, .pressure = limit(normal.nodes), .approach = last};
    slipping.held = static_cast<Index>(normal.nodes.size());
    solution.steps.push_back(std::move(slipping));
    std::vector<LoadStep> rows;
    for (const StepSolution& step : solution.steps)
        rows.push_back(load_step(problem, step.approach * problem.displacement_unit, step));
    return rows;
}

double full_contact_stiffness(const Profile& surface, const Body& given, int threads) {
    if (given.kernel == Kernel::periodic) { // on a rigid base 1/C0
        const double modulus = given.effective_modulus;
        return modulus / mean_compliance(given.layering, modulus);
    }
    Profile flat = surface;
    flat.heights.setZero();
    const double length = profile_length(flat, given.kernel);
    const Body body = completed(given, length);
    checked_body(flat, body);
    Body at_length = body;
    at_length.datum = length;
    Team team(useful_threads(flat, threads));
    const ContactProblem problem = make_problem(flat, at_length, {}, team);
    flat.heights.resize(0); // a large map needs its memory below
    const bool strip = body.kernel == Kernel::strip;
    const double other = strip ? problem.strip_width : problem.row_spacing;
    const double stiffness =
        problem.stiffness_unit * known_sum({body.kernel, problem.nodes(), problem.shape.rows, other}, problem);
    if (strip || problem.is_2d()) return stiffness;
    // 1/K(d) = 1/K(L) + (2 L/(pi E*)) ln(d/L)
    return 1 / (1 / stiffness - datum_sensitivity(1, length, body.effective_modulus) * std::log(*body.datum / length));
}

double full_contact_load(const Profile& profile, const Body& body) {
    const ContactProblem problem = make_problem(profile, body, {});
    return -full_contact_pressure(problem).minCoeff() * problem.pressure_unit;
}

} // namespace rough
