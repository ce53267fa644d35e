#pragma once

#include "domain/contact/solve.hpp"

#include <memory>

namespace rough {

/// A rectangular array of caps. Cap number j columns + i is at ((i + 1/2) pitch, (j + 1/2) pitch).
struct CapArray {
    Index columns = 8;  ///< number of caps along x
    Index rows = 8;     ///< number of caps along y
    double pitch = 1.5; ///< distance of neighbours, mm

    Index caps() const { return columns * rows; } ///< number of caps N
    /// x of a cap, mm.
    double x(Index cap) const { return (static_cast<double>(cap % columns) + 0.5) * pitch; }
    /// y of a cap, mm.
    double y(Index cap) const { return (static_cast<double>(cap / columns) + 0.5) * pitch; }
    double nominal_area() const { return static_cast<double>(caps()) * pitch * pitch; } ///< N pitch^2, mm^2
};

/// The periodic grid of an array's nominal area, with 16 nodes per pitch and at most 128 x 128 nodes.
Grid grid_of(const CapArray& array);

/// Spherical caps in an array.
struct Caps {
    CapArray array;          ///< positions of the caps
    Eigen::VectorXd heights; ///< heights h_i of the summits above the base, mm
    Eigen::VectorXd radii;   ///< radii R_i, mm
};

/// The contact of caps with a flat body that is pressed on them.
struct CapState {
    double plane = 0;            ///< height of the undeformed flat body above the base, mm
    Eigen::VectorXd indentation; ///< indentations delta_i, mm; not above 0 for caps that do not touch
    Eigen::VectorXd force;       ///< forces F_i, N
    Eigen::VectorXd area;        ///< contact areas A_i = pi R_i delta_i, mm^2
    double stiffness = 0;        ///< dF/dDelta at this contact, N/mm; Delta is the approach

    double load() const { return force.sum(); }      ///< load F, the sum of all forces, N
    double total_area() const { return area.sum(); } ///< contact area A of all caps, mm^2
};

/// Derivatives of one quantity at a fixed plane.
struct CapSlope {
    Eigen::VectorXd by_heights; ///< derivatives with respect to each height, per mm
    Eigen::VectorXd by_radii;   ///< derivatives with respect to each radius, per mm

    /// Derivative with respect to the plane, with all summits fixed, per mm.
    double by_plane() const { return -by_heights.sum(); }
};
/// Derivatives of load, area and stiffness.
struct CapSlopes {
    CapSlope load;      ///< derivatives of F, N
    CapSlope area;      ///< derivatives of A, mm^2
    CapSlope stiffness; ///< derivatives of dF/dDelta, N/mm
};

/// Models of the contact of caps on a half-space. Hertz's theory gives F_i = 4/3 E* sqrt(R_i) delta_i^(3/2).
/// Caps that do not touch have no force. Independent caps have delta_i = h_i - plane. For interacting caps,
/// each force also moves the surface of the half-space away from the other caps, as a point load does. So
/// delta_i = h_i - plane - sum_j F_j/(pi E* r_ij), with the distance r_ij of two caps.
enum class CapModel { independent, interacting };

/// Solves the contact of caps with the positions of one array, under one model.
class CapContact {
  public:
    CapContact(const CapArray& array, double effective_modulus, CapModel model); ///< E* in MPa

    /// The contact under a load (N, > 0), by Newton's method. `start` is the contact under a similar load.
    /// Throws NotConverged if caps are so near to each other that point loads do not describe them.
    CapState at_load(const Caps& caps, double load, const CapState* start = nullptr) const;
    /// The contact with a flat body at this height above the base (mm). Throws as at_load().
    CapState at_plane(const Caps& caps, double plane, const CapState* start = nullptr) const;
    /// The derivatives at a contact, by the adjoint of the contact's equations.
    CapSlopes slopes(const Caps& caps, const CapState& state) const;

  private:
    CapState solve(const Caps& caps, double load, double plane, const CapState* start) const;

    double modulus_;
    std::shared_ptr<const Eigen::MatrixXd> influence_; ///< 1/(pi E* r_ij), zero on the diagonal; null: none
};

/// The contact area of one cap under a force: pi (3 F R/(4 E*))^(2/3), mm^2.
double hertz_area(double force, double radius, double effective_modulus);

/// The caps as a map of about `nodes` nodes, mm. Caps are spheres if `spheres` is set, otherwise paraboloids,
/// as in Hertz's theory. Nodes are the centres of square cells. One pitch contains an odd number of cells
/// along each axis. `depth` is the depth of the base below the lowest summit, mm.
Profile map_of(const Caps& caps, double nodes, bool spheres, double depth);

/// The contact of caps as solved by boundary elements.
struct MeshedCaps {
    double load = 0;           ///< load, N
    Eigen::VectorXd force;     ///< force of each cap, N, from the nodes in the pitch x pitch square around it
    Eigen::VectorXd area;      ///< contact area of each cap, from its force by hertz_area(), mm^2
    Eigen::VectorXd area_low;  ///< lower limit, mm^2: cells of touching nodes with four touching neighbours
    Eigen::VectorXd area_high; ///< upper limit, mm^2: cells of nodes that touch or have a touching neighbour
    double approach = 0;       ///< approach from first touch, mm
    double stiffness = 0;      ///< dF/dDelta at this contact, N/mm
    double kkt_residual = 0;   ///< certificate of the solution
};

/// The contact of caps (as paraboloids) with a half-space by boundary elements, on a map of about `nodes` nodes. `at`
/// are increasing loads (N), or increasing approaches (mm) if `loads` is false. Throws what solve_contact() throws.
std::vector<MeshedCaps> pressed_on_mesh(const Caps& caps, double effective_modulus, const std::vector<double>& at,
                                        bool loads = true, double nodes = 1 << 20, const ContactOptions& options = {});

} // namespace rough
