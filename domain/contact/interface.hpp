#pragma once

#include "domain/contact/solve.hpp"
#include "domain/numerics/connected.hpp"

namespace rough {

/// Usual width w of the contact spots in nodes; 0 without contact. Half of the touching nodes are in spots of
/// at most w nodes on a line, or of at most w^2 nodes on a map. A spot is a group as in group_sizes().
Index spot_width(const std::vector<int>& contact, Extent shape, bool periodic);

/// Pressure and gap between a surface and the body at one load step, along a profile or at a map's nodes.
struct Interface {
    Eigen::VectorXd pressure; ///< pressure at every node, MPa; 0 at nodes that do not touch
    Eigen::VectorXd gap;      ///< gap between the deformed body and the surface, mm; about 0 in contact
    Index spots = 0;          ///< number of contact spots; on a periodic body a spot may include both ends
    double widest = 0;        ///< width of the widest spot of a line, mm; for a map the area of the largest, mm^2
};

/// The interface at a load step from solve_contact(), with its state and the same surface and body. The gap
/// is u - (Delta - g0), with u computed from the pressures by FFT. Zeros of the body get their defaults.
Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step, const ContactState& state);

/// A contact fraction that changes smoothly with the heights. It has a gradient, unlike a count of nodes. The
/// edge of contact between a touching node i and a free neighbour k is at the fraction d/(d + e) of their
/// distance. d = p_i/w_i is the displacement since i touched, and e = gap_k/(1 - (H w)_k) that until k
/// touches. w is ContactState::tangent. While one node comes into contact, the mean of this fraction equals
/// that of the count. On a map, edges along x and along y count half each.
struct SmoothArea {
    Eigen::VectorXd fraction;        ///< one per load step
    Eigen::VectorXd by_displacement; ///< d fraction/d Delta_j with the heights fixed, 1/mm
    Eigen::MatrixXd by_height;       ///< d fraction/dZ_i with Delta_j fixed, steps x N, 1/mm
};

/// The smooth contact fraction of a curve with states (ContactOptions::states). One linear solution on each
/// step's contact set gives the derivatives (adjoint). Without derivatives, they are 0.
SmoothArea smooth_area(const Profile& profile, const Body& body, const ContactCurve& curve,
                       bool with_derivatives = true);

} // namespace rough
