#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

#include <functional>

namespace rough {

/// The method of a contact solution; `automatic` decides by a fixed cost model (choose_solver), never by a
/// clock.
enum class Solver { automatic, nested, nnls, polonsky_keer, active_set };

const std::vector<std::string>& solver_names(); ///< in the order of Solver
const std::string& name_of(Solver solver);      ///< auto, nested, nnls, polonsky-keer or active-set
/// Whether the solver factorises the influence matrix H. Its error is then only rounding, and
/// ContactOptions::tolerance is not used.
bool is_direct(Solver solver);

/// How contact is to be solved.
struct ContactOptions {
    Solver solver = Solver::automatic; ///< which method
    double tolerance = 1e-6;           ///< relative residual at which an iterative solver ends
    bool states = false;       ///< keep each step's contact set, pressures and tangent vector for the adjoint
    double memory_limit = 2e9; ///< bytes; a factorisation predicted to need more is refused
    int threads = 1; ///< threads for a map of 16,384 nodes or more; the curve does not depend on their number
    std::function<bool()> stop = {}; ///< called repeatedly if set; true ends the solution with NotConverged
};

/// Whether `stop` is set and returns true.
inline bool is_stopped(const ContactOptions& options) { return options.stop && options.stop(); }

/// The solution of one load step. Pressures are means over the nominal area (MPa), for a line over its
/// length. Lengths in mm.
struct LoadStep {
    /// Approach Delta since first touch, mm. On a periodic half-plane or half-space it is measured against
    /// the mean plane of the body's surface.
    double displacement = 0;
    double pressure = 0;          ///< P, MPa: sum p_i delta / L of a line, sum p_i / N of a map
    double tangent_stiffness = 0; ///< dP/dDelta at the step's contact set, MPa/mm
    double kkt_residual = 0;      ///< certificate (solve_contact), relative
    Index contact_nodes = 0;      ///< number of nodes that touch
    Index held_nodes = 0;         ///< number of nodes whose pressure is limited by the hardness
    double contact_fraction = 0;  ///< contact_nodes / N
};

/// The contact set of one load step, with the values that the adjoint needs.
struct ContactState {
    std::vector<int> nodes;   ///< A, indices into the profile
    Eigen::VectorXd pressure; ///< p on A, MPa, same order
    /// w = H_AA^-1 1 on A, MPa/mm, same order, 0 at held nodes; dP/dDelta = (delta/L) sum w
    Eigen::VectorXd tangent;
};

/// The result of pressing a profile step by step.
struct ContactCurve {
    std::vector<LoadStep> steps;       ///< one per displacement, in the order given
    std::vector<ContactState> states;  ///< same length as steps; empty unless options.states
    std::vector<int> last_contact;     ///< nodes that touch at the last step
    Solver solver = Solver::automatic; ///< the solver that was used
    std::string choice;                ///< why `automatic` chose it, in words
    long iterations = 0;               ///< number of iterations over all steps, as the solver counts them
};

/// Presses a rigid profile on an elastic body to each of the displacements Delta (mm, >= 0, increasing).
/// Solves u = H p, p >= 0, u - (Delta - g0) >= 0, p (u - (Delta - g0)) = 0. The unknowns are the pressures
/// p_i of the nodes and the displacements u_i of the body's surface. H is the influence matrix (kernel.hpp).
/// g0_i = max(Z) - Z_i is the gap at first touch; Z_i are the heights. The certificate (kkt_residual) is the
/// largest relative violation of these conditions, with H p computed by a method different from the solver's.
///
/// At Delta = 0 the touching nodes count as contact without pressure, so that K is the stiffness of first
/// loading. `automatic` continues with another solver if the chosen one does not settle, needs too much
/// memory or far more work than predicted.
///
/// With a hardness p_H, pressures are at most p_H. Nodes at p_H (held nodes) may sink in, so that u <= Delta
/// - g0 there. K is then that of the elastic nodes. Only `automatic` and `active_set` accept a hardness. A
/// projected Newton method solves steps with held nodes until the residual of the gaps is 1e-11 of the
/// approach, or rounding limits it.
///
/// Throws InputError if a profile, body or displacement has no solution. Throws NotConverged if the
/// certificate of a step exceeds its limit. For an iterative solver the limit is twice `tolerance`. For a
/// direct solver, and with a hardness, it is 1e-9, or the bound of rounding if that is larger.
ContactCurve solve_contact(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options = {});

/// Presses to each of the mean pressures (MPa, > 0, increasing). The table in solvers/solvers.hpp says which
/// solvers take loads. For those that do not, with a hardness, and if `automatic` fails on a line, Newton's
/// method finds the displacements. Without a hardness it converges, because P is convex in Delta. With a
/// hardness the pressure agrees to 1e-8 or better. Throws InputError also for a pressure above that of full
/// contact (periodic).
ContactCurve solve_contact_at_pressures(const Profile& profile, const Body& body,
                                        const std::vector<double>& pressures,
                                        const ContactOptions& options = {});

/// The displacement at which the mean pressure is `pressure` (MPa, > 0), mm. With a direct solver, the
/// pressure at this displacement agrees with `pressure` to 12 digits, and with a hardness to at least 8. For
/// lines, an iterative solver is given a pressure that is larger by 2 tolerances (relative). A curve to this
/// displacement therefore ends between `pressure` and 3 tolerances above it. Throws the same as
/// solve_contact_at_pressures.
double displacement_at_pressure(const Profile& profile, const Body& body, double pressure,
                                ContactOptions options = {});

/// Converts a solved curve and its states to another datum (mm), exactly and without a new contact solution.
/// The surface must be a line on the free half-plane, and the datum must exceed (L + delta)/4. Throws
/// InputError otherwise. A datum of 0 stands for L.
ContactCurve with_datum(ContactCurve curve, const Profile& profile, const Body& body, double datum);

/// Predicted cost of a curve of `steps` steps on `nodes` nodes by the cheaper of the solvers nested and
/// active_set. `contact` nodes touch at the last step. Only ratios of costs have a meaning.
double predicted_cost(double nodes, double contact, double steps);

/// K_full, MPa/mm: the stiffness of the body when all `nodes` of a grid, `spacing` mm apart, are in contact:
/// K_full = (delta/L) 1' H^-1 1. It is infinite on a periodic half-plane, whose displacement is relative to
/// the mean plane. For layers on a rigid base it is E* / mean_compliance().
///
/// The interface stiffness K_i of 1/K_i = 1/K - 1/K_full does not depend on the datum. Conjugate gradients
/// solve H w = 1. On the free half-plane the datum is then d = L. An exact formula converts that result to
/// the body's datum. The solution is cached for all threads. Throws InputError for a body without a solution.
/// Throws NotConverged if the residual of H w = 1 exceeds 1e-8.
double full_contact_stiffness(Index nodes, double spacing, const Body& body);
/// K_full on the grid of a line or a map, computed on up to `threads` threads. A free map has no datum.
double full_contact_stiffness(const Profile& surface, const Body& body, int threads = 1);

/// The mean pressure (MPa) at which a periodic profile reaches full contact without tension at any node. It
/// is minus the lowest nodal pressure of the zero-mean full-contact field. Throws InputError for a body
/// without a solution.
double full_contact_load(const Profile& profile, const Body& body);

} // namespace rough
