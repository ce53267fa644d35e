#pragma once

#include "domain/contact/solve.hpp"

#include <memory>

namespace rough {

/// A rectangular array of caps. Cap number j columns + i is at ((i + 1/2) pitch, (j + 1/2) pitch).
struct CapArray {
    Index columns = 8;  ///< along x
    Index rows = 8;     ///< along y
    double pitch = 1.5; ///< distance of neighbours, mm

    Index caps() const { return columns * rows; } ///< number of caps N
    double x(Index cap) const { return (static_cast<double>(cap % columns) + 0.5) * pitch; } ///< mm
    double y(Index cap) const { return (static_cast<double>(cap / columns) + 0.5) * pitch; } ///< mm
    double nominal_area() const { return static_cast<double>(caps()) * pitch * pitch; }      ///< mm^2
};

/// Spherical caps in an array.
struct Caps {
    CapArray array;          ///< positions of the caps
    Eigen::VectorXd heights; ///< h_i of the summits above the base, mm
    Eigen::VectorXd radii;   ///< R_i, mm
};

/// Caps that a flat body presses. Forces in N.
struct PressedCaps {
    double plane = 0;            ///< height of the undeformed flat body above the base, mm
    Eigen::VectorXd indentation; ///< delta_i, mm; not above 0 for caps that do not touch
    Eigen::VectorXd force;       ///< F_i, N
    Eigen::VectorXd area;        ///< A_i = pi R_i delta_i, mm^2
    double stiffness = 0;        ///< dF/dDelta at this contact, N/mm

    double load() const { return force.sum(); }      ///< F, N
    double total_area() const { return area.sum(); } ///< A, mm^2
};

/// Derivatives of one quantity at a fixed plane. With respect to the plane the derivative is minus the sum of
/// those with respect to the heights.
struct CapSlope {
    Eigen::VectorXd by_heights; ///< per mm of each height
    Eigen::VectorXd by_radii;   ///< per mm of each radius

    double by_plane() const { return -by_heights.sum(); } ///< with all summits fixed
};
/// The slopes of load, area and stiffness.
struct CapSlopes {
    CapSlope load;      ///< derivatives of F, N
    CapSlope area;      ///< derivatives of A, mm^2
    CapSlope stiffness; ///< derivatives of dF/dDelta, N/mm
};

/// Contact of caps on a half-space by Hertz's theory, F_i = 4/3 E* sqrt(R_i) delta_i^(3/2). Caps that do not
/// touch have no force. Independent caps have delta_i = h_i - plane. For interacting caps, each force lowers
/// the half-space under the other caps as a point load does. Then delta_i = h_i - plane -
/// sum_j F_j/(pi E* r_ij), with r_ij the distance of the caps.
enum class CapModel { independent, interacting };

/// The caps of one array under one model; the geometry is shared by copies.
class CapContact {
  public:
    /// `effective_modulus` is E*, MPa.
    CapContact(const CapArray& array, double effective_modulus, CapModel model);

    /// The caps under a load (N, > 0), by Newton's method. `start` is the contact under a load near to it.
    /// Throws NotConverged if caps are so near to each other that point loads do not describe them.
    PressedCaps at_load(const Caps& caps, double load, const PressedCaps* start = nullptr) const;
    /// The caps under a flat body at this height above the base (mm); throws as at_load().
    PressedCaps at_plane(const Caps& caps, double plane, const PressedCaps* start = nullptr) const;
    /// The derivatives at a contact, by the adjoint of the contact's equations.
    CapSlopes slopes(const Caps& caps, const PressedCaps& pressed) const;

  private:
    PressedCaps solve(const Caps& caps, double load, double plane, const PressedCaps* start) const;

    double modulus_;
    std::shared_ptr<const Eigen::MatrixXd> influence_; ///< 1/(pi E* r_ij), zero on the diagonal; null: none
};

/// Area of one cap under a force: pi (3 F R/(4 E*))^(2/3), mm^2.
double hertz_area(double force, double radius, double effective_modulus);

/// The caps as a map of about `nodes` nodes, mm: paraboloids as Hertz's theory assumes, or spheres. Nodes are
/// the centres of square cells, an odd number of them along each pitch. `depth` is that of the base below the
/// lowest summit, mm.
Profile map_of(const Caps& caps, double nodes, bool spheres, double depth);

/// Caps pressed by boundary elements.
struct MeshedCaps {
    double load = 0;           ///< N
    Eigen::VectorXd force;     ///< force of each cap, N: the sum over the nodes of its pitch x pitch cell
    Eigen::VectorXd area;      ///< mm^2, from each force by hertz_area()
    Eigen::VectorXd area_low;  ///< mm^2 of the nodes that touch and whose four neighbours do
    Eigen::VectorXd area_high; ///< mm^2 of the nodes that touch or have a neighbour that does
    double approach = 0;       ///< from first touch, mm
    double stiffness = 0;      ///< dF/dDelta at this contact, N/mm
    double kkt_residual = 0;   ///< certificate of the solution
};

/// The caps' map of paraboloids on a half-space under each of these loads (N) or approaches (mm), increasing.
/// Solved by boundary elements on a map of about `nodes` nodes. Throws what solve_contact() throws.
std::vector<MeshedCaps> pressed_on_mesh(const Caps& caps, double effective_modulus,
                                        const std::vector<double>& at, bool loads = true,
                                        double nodes = 1 << 20, const ContactOptions& options = {});

} // namespace rough
