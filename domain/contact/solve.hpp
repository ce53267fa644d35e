#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

#include <functional>

namespace rough {

/// The method of a contact solution. `automatic` chooses `nested` or `active_set` by a fixed model of cost
/// and memory, never by a clock. On a layered body whose contact sets may shrink (contact_sets_nest), it
/// chooses `nnls` for a line of at most 768 nodes, otherwise `active_set`.
enum class Solver { automatic, nested, nnls, polonsky_keer, active_set };

const std::vector<std::string>& solver_names(); ///< in the order of Solver
const std::string& name_of(Solver solver);      ///< auto, nested, nnls, polonsky-keer or active-set
/// Whether the solver factorises the influence matrix H (kernel.hpp). Its error is then only rounding, and
/// ContactOptions::tolerance is not used.
bool is_direct(Solver solver);

/// Options of a contact solution.
struct ContactOptions {
    Solver solver = Solver::automatic; ///< method
    double tolerance = 1e-6;           ///< relative residual at which an iterative solver ends
    bool states = false;               ///< whether to fill ContactCurve::states, which derivatives need (adjoint)
    double memory_limit = 2e9;         ///< bytes; a factorisation that is predicted to need more is refused
    int threads = 1; ///< threads for a map of 16,384 nodes or more; the curve does not depend on their number
    std::function<bool()> stop = {}; ///< called repeatedly if set; true ends the solution with NotConverged
    bool spots = false;              ///< whether LoadStep::spot_width is computed
};

/// Whether `stop` is set and returns true.
inline bool is_stopped(const ContactOptions& options) { return options.stop && options.stop(); }

/// The solution of one load step. N is the number of nodes, and p_i the pressure at node i. A line has the
/// node spacing delta and the length L (profile_length).
struct LoadStep {
    /// Approach Delta since first touch, mm; against the body's mean plane if Body::relative_to_mean().
    double displacement = 0;
    /// Mean pressure P over the nominal area, MPa: for a line sum p_i delta/L, for a map sum p_i/N.
    double pressure = 0;
    double tangent_stiffness = 0; ///< dP/dDelta at the step's contact set, MPa/mm
    double kkt_residual = 0;      ///< certificate of solve_contact(), relative
    Index contact_nodes = 0;      ///< number of nodes that touch
    Index held_nodes = 0;         ///< number of nodes whose pressure is limited by the hardness
    double contact_fraction = 0;  ///< contact_nodes/N
    double largest_pressure = 0;  ///< highest pressure of a node, MPa; 0 if it is not known
    Index spot_width = 0;         ///< usual width of the contact spots in nodes; 0 if it is not known
};

/// The contact set A of one load step, with the values that derivatives need (adjoint).
struct ContactState {
    std::vector<int> nodes;   ///< A: indices of the nodes that touch
    Eigen::VectorXd pressure; ///< pressures at these nodes, MPa
    /// w at these nodes, MPa/mm: 0 at held nodes, H_A'A'^-1 1 at the other nodes A'. dP/dDelta is (delta/L)
    /// sum w for a line, sum w/N for a map.
    Eigen::VectorXd tangent;
};

/// The result of pressing a profile step by step.
struct ContactCurve {
    std::vector<LoadStep> steps;       ///< one for each given displacement or pressure, in the same order
    std::vector<ContactState> states;  ///< one for each step if ContactOptions::states is set, otherwise empty
    std::vector<int> last_contact;     ///< nodes that touch at the last step
    Solver solver = Solver::automatic; ///< the solver that was used last
    long iterations = 0;               ///< number of iterations over all steps, as the solver counts them
};

/// Presses a rigid profile on an elastic body to each of the displacements Delta (mm, >= 0, increasing).
/// README.md states the problem and the certificate (kkt_residual), also with a hardness. At Delta = 0 the
/// touching nodes count as contact without pressure. `automatic` continues with another solver if the chosen
/// one does not converge, needs too much memory, or needs far more work than predicted. A hardness is
/// possible only with `automatic` and `active_set`.
///
/// Throws InputError if a profile, body or displacement has no solution. Throws NotConverged if the
/// certificate of a step exceeds its limit. For an iterative solver the limit is twice `tolerance`. For a
/// direct solver, and with a hardness, it is 1e-9, or the bound of rounding if that is larger.
ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options = {});

/// Presses a rigid profile to each of the mean pressures (MPa, > 0, increasing). `nested` and `polonsky_keer`
/// solve for a given pressure directly, `active_set` only on maps, `nnls` never. Otherwise Newton's method
/// finds the displacement of each pressure. It always does so with a hardness. The mean pressure then agrees
/// with the given one to 1e-8 or better.
///
/// Throws the same as solve_contact(). Also throws InputError for a pressure that no displacement reaches. If
/// Body::relative_to_mean(), the limit is full_contact_load(), inclusive. With a hardness p_H, it is instead
/// the mean pressure of all nodes at p_H, exclusive.
ContactCurve solve_contact_at_pressures(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                                        const ContactOptions& options = {});

/// The displacement (mm) at which the mean pressure is `pressure` (MPa, > 0). With a direct solver, the mean pressure
/// there agrees with `pressure` to 12 digits, with a hardness to at least 8 digits. On a line without a hardness,
/// iterative solvers, and `automatic` on more than 768 nodes, add 2 relative tolerances. So a curve to the result
/// reaches `pressure`, and exceeds it by at most 3 tolerances. Throws the same as solve_contact_at_pressures().
double displacement_at_pressure(const Profile& profile, const Body& body, double pressure, ContactOptions options = {});

/// Partial slip of a line under the constant normal load of the approach `displacement` (mm), with tractions
/// of at most `friction` times the pressure (domain/response/README.md). The tangential displacement rises in
/// `steps` even steps from 0 to full slip, which gives steps + 1 rows. In a row `displacement` is tangential
/// (mm), `pressure` the mean traction Q (MPa), `tangent_stiffness` dQ/d displacement, and `held_nodes` slip.
/// Throws the same as solve_contact(), also InputError for a map.
std::vector<LoadStep> solve_partial_slip(const Profile& profile, const Body& body, double displacement, double friction,
                                         int steps, ContactOptions options = {});

/// Predicted cost of a curve of `steps` steps on `nodes` nodes by the cheaper of the solvers `nested` and
/// `active_set`, in arbitrary units. `contact` nodes touch at the last step.
double predicted_cost(double nodes, double contact, double steps);

/// The stiffness K_full of the body if all nodes of a surface touch, MPa/mm, computed on up to `threads`
/// threads. K_full is the sum of all entries of H^-1 times delta/L for a line, over N for a map. It is
/// infinite if Body::relative_to_mean(), and E*/mean_compliance() for layers on a rigid base. Throws
/// InputError for a body without a solution, and NotConverged if the residual of H w = 1 exceeds 1e-6.
double full_contact_stiffness(const Profile& surface, const Body& body, int threads = 1);

/// The mean pressure (MPa) at which a profile on a periodic body reaches full contact without tension at any
/// node: -min(H^-1 Z). Throws InputError for a body without a solution.
double full_contact_load(const Profile& profile, const Body& body);

} // namespace rough
