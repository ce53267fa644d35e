#pragma once

#include "domain/contact/solve.hpp"
#include "domain/errors.hpp"

#include <utility>

namespace rough {

/// The load steps: the displacements Delta_j = (j/steps) Delta_last, j = 1..steps. Delta_last is `to_displacement` if
/// it is given, otherwise that of `to_pressure` if this is given, otherwise reach * displacement_range().
struct Loading {
    int steps = 20; ///< number of load steps n_t, >= 2
    /// In (0, 1], below 1 for the periodic kernel. Default: 1, periodic 0.95.
    std::optional<double> reach = {};
    std::optional<double> to_pressure = {};     ///< mean pressure at the last load step, MPa
    std::optional<double> to_displacement = {}; ///< displacement at the last load step, mm
    /// Mean pressures of the load steps, MPa, > 0 and increasing. If they are given, they replace all members above.
    std::vector<double> pressures = {};
    /// Displacements over Delta_last, in (0, 1] and increasing. If they are given, they replace the even ones.
    std::vector<double> shares = {};
};

/// Loading::reach or its default.
double reach_of(const Loading& loading, Kernel kernel);

/// Throws InputError if load steps are fewer than 2 and not given as pressures, or if their reach is outside its range.
void validate(const Loading& loading, Kernel kernel);

/// The response of a profile to load steps. The unloaded state (0, 0) is not a row.
struct Response {
    double range = 0;                  ///< range of the heights (Loading), mm
    Eigen::VectorXd displacement;      ///< displacements Delta_j, mm
    Eigen::VectorXd pressure;          ///< mean pressures P_j, MPa
    Eigen::VectorXd contact_fraction;  ///< shares of the nodes that touch
    Eigen::VectorXd tangent_stiffness; ///< dP/dDelta at each step's contact set, MPa/mm
    Eigen::VectorXd kkt_residual;      ///< certificate of each step, dimensionless
    Solver solver = Solver::automatic; ///< solver that was used
    /// Stiffness K_full with all nodes in contact (full_contact_stiffness), MPa/mm. It is infinite on a
    /// periodic half-plane and NaN if it is not known.
    double full_stiffness = std::numeric_limits<double>::quiet_NaN();
    Index held_nodes = 0;                  ///< nodes at the hardness at the last load step
    Eigen::VectorXd largest_pressure = {}; ///< highest pressure of a node, MPa; 0 if it is not known
    Eigen::VectorXd spot_width = {};       ///< usual width of the contact spots, nodes; 0 if it is not known

    Index steps() const { return displacement.size(); } ///< number of load steps
};

/// The load steps of two responses of one surface, by rising displacement.
Response merged(const Response& a, const Response& b);

/// The response with these load steps as rows; `range` in mm, `full_stiffness` in MPa/mm.
Response response_of(const std::vector<LoadStep>& steps, Solver solver, double range,
                     double full_stiffness = std::numeric_limits<double>::quiet_NaN());

/// The range of a profile's heights Z: max Z - min Z, for the periodic kernel max Z - mean Z. Throws
/// InputError if it is zero or a height is not finite.
double displacement_range(const Profile& profile, Kernel kernel);

/// The displacements of load steps whose end follows from `reach`, mm. Throws InputError on steps < 2 or a
/// reach outside its range.
std::vector<double> load_displacements(double range, const Loading& loading, Kernel kernel);

/// The displacements of load steps with any end, mm. Throws InputError on steps < 2, an end that the profile
/// cannot reach, or pressures that do not increase.
std::vector<double> step_displacements(const Profile& profile, const Body& body, const Loading& loading,
                                       const ContactOptions& options = {});

/// Presses the profile to the load steps. Throws what step_displacements() and solve_contact() throw.
ContactCurve solve_load_steps(const Profile& profile, const Body& body, const Loading& loading,
                              const ContactOptions& options = {});

/// The response of a profile. K(p) of an array of heights is secant_stiffness(respond({heights, spacing})).
/// Throws InputError on a profile, body or loading without a solution, and NotConverged if the certificate of
/// a step is above the tolerance.
Response respond(const Profile& profile, const Body& body = {}, const Loading& loading = {},
                 const ContactOptions& options = {});

/// respond() with smooth contact fractions (contact/interface.hpp). Throws InputError on a hardness, too.
Response respond_smoothly(const Profile& profile, const Body& body, const Loading& loading,
                          ContactOptions options = {});

/// Derivatives of a response with respect to the heights Z_i (columns), or to genes (in_genes).
struct ResponseJacobian {
    Eigen::MatrixXd pressure;             ///< dP_j, one row per load step; over the heights a row sums to zero
    Eigen::RowVectorXd last_displacement; ///< d Delta_nt; those of other steps are fractions of it
    Eigen::MatrixXd contact_fraction;     ///< d fraction_j (smooth), one row per step; empty if not requested
};

/// A response and its derivatives with respect to the N heights, by the adjoint (README.md).
struct ResponseWithGradient {
    Response response;               ///< as from respond()
    ResponseJacobian gradient;       ///< MPa/mm, 1 and 1/mm
    Eigen::VectorXd smooth_fraction; ///< contact fraction (contact/interface.hpp); empty if not requested
};
/// respond() with derivatives. Also throws InputError if the load steps are at given pressures, and on
/// derivatives of the contact fraction for a body with a hardness.
ResponseWithGradient respond_with_gradient(const Profile& profile, const Body& body, const Loading& loading,
                                           ContactOptions options = {}, bool with_area = false);

/// The response of a profile whose heights are multiplied by `factor` (> 0), which multiplies displacements
/// and pressures. Throws InputError if the result exceeds double precision or nodes are at a hardness.
Response scaled(Response response, double factor);

/// The model of a response: grid, body, load steps and solver. A target is valid for its kernel and datum.
struct Model {
    Grid grid{};              ///< nodes of the surface
    Body body{};              ///< elastic body
    Loading loading{};        ///< load steps
    ContactOptions contact{}; ///< solver
    /// Largest relative error of a genome's response that approximations may cause (domain/accuracy); 0: no
    /// approximations.
    double accuracy = 0;
};

/// The complete model: the body gets its defaults for the grid's length, and `reach` that of the kernel. The grid
/// becomes periodic if the kernel is periodic, and only then. Every other function takes complete models.
inline Model completed(Model model) {
    model.grid.periodic = model.body.kernel == Kernel::periodic;
    model.body = completed(model.body, model.grid.length);
    model.loading.reach = reach_of(model.loading, model.body.kernel);
    return model;
}

/// Throws InputError if the model is not complete, or its body or load steps have no solution on its grid.
inline void validate(const Model& model) {
    if (model.grid.periodic != (model.body.kernel == Kernel::periodic))
        refuse_value("kernel", name_of(model.body.kernel), " does not fit the grid; complete the model");
    validate(model.body, model.grid.nodes, model.grid.spacing());
    validate(model.loading, model.body.kernel);
}

/// The response of a profile under the model.
inline Response respond(const Profile& profile, const Model& model) {
    return respond(profile, model.body, model.loading, model.contact);
}

/// The model on a grid with `refine` elements for each element of its grid.
inline Model refined(Model model, Index refine) {
    model.grid = refined(model.grid, refine);
    return model;
}

/// Pairs of name with unit and value, in a fixed order.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// A number with 17 digits, which reads back exactly.
std::string field_text(double value);

/// A model as fields. Solver and tolerance are omitted, because solvers agree to the tolerance of their certificate.
NamedValues named_values(const Model& model);

} // namespace rough
