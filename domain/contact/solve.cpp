#include "domain/contact/solve.hpp"

#include "domain/contact/nested.hpp"
#include "domain/contact/nnls.hpp"
#include "domain/contact/problem.hpp"
#include "domain/errors.hpp"

namespace rough {

namespace {

ContactCurve in_units(const ContactProblem& problem, const std::vector<double>& displacements,
                      Solution solution, bool states) {
    ContactCurve curve;
    curve.iterations = solution.iterations;
    for (std::size_t j = 0; j < solution.steps.size(); ++j) {
        StepSolution& found = solution.steps[j];
        LoadStep step;
        step.displacement = displacements[j];
        step.pressure = found.pressure.sum() / problem.elements * problem.pressure_unit;
        step.tangent_stiffness = found.stiffness * problem.stiffness_unit;
        step.kkt_residual = found.residual;
        step.contact_nodes = static_cast<Index>(found.nodes.size());
        step.contact_fraction =
            static_cast<double>(step.contact_nodes) / static_cast<double>(problem.nodes());
        curve.steps.push_back(step);
        if (states) {
            // w = H_AA^-1 1 in MPa/mm, so that dP/dDelta = (delta/L) sum w
            const double tangent_unit = problem.stiffness_unit * problem.elements;
            curve.states.push_back({std::move(found.nodes), found.pressure * problem.pressure_unit,
                                    found.tangent * tangent_unit});
        }
    }
    return curve;
}

Solution solve(const ContactProblem& problem, Solver solver, const ContactOptions& options) {
    switch (solver) {
    case Solver::nnls:
        return solve_nnls(problem, options.states);
    default:
        return solve_nested(problem, options.states);
    }
}

} // namespace

ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options) {
    const ContactProblem problem = make_problem(profile, body, displacements);
    const Solver solver = options.solver == Solver::automatic ? Solver::nested : options.solver;
    ContactCurve curve = in_units(problem, displacements, solve(problem, solver, options), options.states);
    curve.solver = solver;
    return curve;
}

} // namespace rough
