#pragma once

#include "domain/contact/kernel.hpp"
#include "domain/contact/solve.hpp"
#include "domain/numerics/fourier.hpp"

namespace rough {

/// ContactProblem::work_limit without a limit.
constexpr double unlimited_work = std::numeric_limits<double>::infinity();

/// A contact problem without units, as every solver takes it. Heights are in units of the largest
/// displacement, lengths along the surface in units of delta (for a map delta_x). Pressures are in units of
/// E* times the largest displacement over delta.
struct ContactProblem : UnitBody {
    Extent shape;                 ///< nodes along x and y; only operators and neighbours depend on it
    Eigen::VectorXd column;       ///< first column of H
    Eigen::VectorXd gap;          ///< g0_i = max Z - Z_i >= 0
    std::vector<double> approach; ///< displacements, increasing, the last one 1 (or all zero)
    std::vector<double> load;     ///< used instead under load control: sums of the nodes' pressures, increasing
    double cap;                   ///< p_H, infinite without a hardness

    double displacement_unit; ///< mm
    double pressure_unit;     ///< MPa per unit of a node's pressure
    double elements;          ///< L/delta, on a map N: P = sum p / elements
    double stiffness_unit;    ///< MPa/mm, E*/(elements delta): K = stiffness_unit * sum w

    Team* team = &Team::alone(); ///< shares the loops over a map's nodes; outlives the problem

    double work_limit = unlimited_work; ///< multiplications after which a factor gives up, nested or of NNLS

    Index nodes() const { return gap.size(); } ///< N
    /// Load steps to solve.
    std::size_t steps() const { return load.empty() ? approach.size() : load.size(); }
    /// Whether H of all nodes together is singular: displacements are relative to the mean plane.
    bool is_singular() const { return kernel == Kernel::periodic && !layering.carries_mean(traction); }
};

/// Throws InputError for every reason to refuse a contact problem. Returns the completed body.
Body checked_body(const Profile& profile, const Body& body, const std::vector<double>& displacements = {});
/// Makes the problem of a surface and body that checked_body() accepts, and throws as it does.
ContactProblem make_problem(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                            Team& team = Team::alone());
/// A problem under load control, to mean pressures in MPa; heights are in units of their range.
ContactProblem make_problem_at(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                               Team& team = Team::alone());

/// Number of threads that is useful for a surface: 1 for lines and for maps of fewer than 128 x 128 nodes.
int useful_threads(const Profile& profile, int threads);

/// The problem on every `stride`-th node, along x and y, with `node` among them. If is_singular(), approaches
/// keep their share of that of full contact, which a grid of another length has elsewhere.
ContactProblem coarsened(const ContactProblem& problem, Index stride, Index node = 0);

/// Pressures of full contact on a periodic body, less their mean: p = P + H^-1 Z.
Eigen::VectorXd full_contact_pressure(const ContactProblem& problem);

/// H applied by FFT.
FourierOperator fourier_operator(const ContactProblem& problem);

/// One step's solution in the problem's units.
struct StepSolution {
    std::vector<int> nodes = {};   ///< contact set
    Eigen::VectorXd pressure = {}; ///< on the contact set
    double stiffness = 0;          ///< sum of H_AA^-1 1
    Eigen::VectorXd tangent = {};  ///< H_AA^-1 1, if options.states
    double residual = 0;           ///< certificate
    Index held = 0;                ///< nodes at the cap
    double approach = 0;           ///< the one found under load control
};

/// The result of a solver.
struct Solution {
    std::vector<StepSolution> steps; ///< one per approach or load
    long iterations = 0;             ///< in the solver's unit, over all steps
};

/// Adds the steps of a problem to a solution. solve_step(approach, load) of a Method solves one to an
/// approach or, under load control, to a load. iterations() counts them in the solver's unit.
template <class Method>
void solve_steps(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    Method solver(problem, options);
    for (std::size_t j = 0; j < problem.steps(); ++j) {
        const long before = solver.iterations();
        solution.steps.push_back(problem.load.empty() ? solver.solve_step(problem.approach[j], {})
                                                      : solver.solve_step(0, problem.load[j]));
        solution.iterations += solver.iterations() - before;
    }
}

/// Throws NotConverged if the options' `stop` returns true.
void check_stop(const ContactOptions& options);

} // namespace rough
