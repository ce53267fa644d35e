#pragma once

#include "domain/contact/solve.hpp"

#include <limits>

namespace rough {

/// The load steps: Delta_j = (j / steps) Delta_last, j = 1..steps. Where the load ends is, in this order,
/// `to_displacement`, the displacement at which the mean pressure is `to_pressure`, or reach * range with
/// range = max Z - min Z (periodic kernel: max Z - mean Z, at which contact is full).
struct Loading {
    int steps = 20;             ///< n_t >= 2
    double reach = 0;           ///< (0, 1], below 1 for the periodic kernel; 0: 1, and 0.95 for the periodic
    double to_pressure = 0;     ///< MPa; 0: not asked for
    double to_displacement = 0; ///< mm; 0: not asked for
    /// In place of all this: a load step at each of these mean pressures, MPa, > 0 and increasing.
    std::vector<double> pressures = {};
};

/// The load steps with a reach that was left at 0 filled in.
Loading completed(Loading loading, Kernel kernel);

/// Throws InputError on completed load steps that no profile can take: fewer than 2, or a reach outside its
/// range.
void validate(const Loading& loading, Kernel kernel);

/// What a profile answers to the load steps. The unloaded state (0, 0) is not among the rows.
struct Response {
    double range = 0;                  ///< mm
    Eigen::VectorXd displacement;      ///< Delta_j, mm
    Eigen::VectorXd pressure;          ///< P_j, MPa
    Eigen::VectorXd contact_fraction;  ///< contact nodes / N
    Eigen::VectorXd tangent_stiffness; ///< MPa/mm
    Eigen::VectorXd kkt_residual;      ///< certificate of each step, scale-free
    Solver solver = Solver::automatic; ///< the one that was used
    /// K_full, MPa/mm: of the same body with every node of the grid in contact (full_contact_stiffness);
    /// infinite on a periodic half-plane, no number where it is not known
    double full_stiffness = std::numeric_limits<double>::quiet_NaN();
    Index held_nodes = 0; ///< at the last load step, how many bear the hardness

    Index steps() const { return displacement.size(); } ///< how many load steps
};

/// The response whose rows are these load steps; `range` in mm, `full_stiffness` in MPa/mm.
Response response_of(const std::vector<LoadStep>& steps, Solver solver, double range,
                     double full_stiffness = std::numeric_limits<double>::quiet_NaN());

/// How a response changes with the heights, by the adjoint (no further solve).
struct ResponseGradient {
    Eigen::MatrixXd pressure;             ///< dP_j/dZ_i, steps x N, MPa/mm; each row sums to zero
    Eigen::RowVectorXd last_displacement; ///< d Delta_nt/dZ_i, N; the other steps' are fractions of it
};

/// range of a profile: max - min, or max - mean for the periodic kernel. Throws InputError if it is zero
/// (a constant profile) or a height is not finite.
double displacement_range(const Profile& profile, Kernel kernel);

/// The displacements of load steps that end by reach alone, mm. Throws InputError on steps < 2 or a reach
/// outside its range.
std::vector<double> load_displacements(double range, const Loading& loading, Kernel kernel);

/// The displacements of the load steps wherever they end, mm. Throws InputError on steps < 2, an end that
/// the profile has not, or pressures that do not increase.
std::vector<double> step_displacements(const Profile& profile, const Body& body, const Loading& loading,
                                       const ContactOptions& options = {});

/// Presses the profile as the loading says. Throws as step_displacements() and the solutions do.
ContactCurve press(const Profile& profile, const Body& body, const Loading& loading,
                   const ContactOptions& options = {});

/// What press() finds, as a response: K(p) of an array of heights is
/// secant_stiffness(respond({heights, spacing})). Throws InputError on a profile, body or
/// loading without a solution, NotConverged where a step's certificate is above tolerance.
Response respond(const Profile& profile, const Body& body = {}, const Loading& loading = {},
                 const ContactOptions& options = {});

/// A smooth contact fraction (smooth_area.hpp) and how it changes with the heights, for area targets.
struct AreaGradient {
    Eigen::VectorXd fraction;   ///< one a step; empty where it was not asked for
    Eigen::MatrixXd by_heights; ///< d fraction_j/dZ_i, steps x N, 1/mm, the displacements moving along
};

/// A response and how it changes with the heights.
struct ResponseWithGradient {
    Response response;         ///< as respond() gives it
    ResponseGradient gradient; ///< with respect to every height
    AreaGradient area;         ///< empty unless asked for
};
/// respond() with its adjoint, at the cost of the tangents alone; with the area's, at that of one solve more
/// a step. Throws InputError also where the load steps are at given pressures, and on the area's gradient
/// of a body with a hardness.
ResponseWithGradient respond_with_gradient(const Profile& profile, const Body& body, const Loading& loading,
                                           ContactOptions options = {}, bool with_area = false);

/// The response of the profile times `factor` (> 0): displacements and pressures scale, stiffness and area
/// stay. Throws InputError where they do not fit double precision, or nodes are held at a hardness, which
/// does not scale.
Response scaled(Response response, double factor);

} // namespace rough
