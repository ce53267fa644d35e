#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// Calls visit(node) for each neighbour of a node along x, then, if there are several rows, along y. If
/// `periodic`, opposite ends of the grid are neighbours.
template <class Visit>
void each_neighbour(Index node, Extent shape, bool periodic, Visit visit) {
    const auto beside = [&](Index at, Index count) {
        return periodic ? (at + count) % count : at < count ? at : -1;
    };
    const Index i = node % shape.columns, j = node / shape.columns;
    for (const Index by : {-1, 1})
        if (const Index column = beside(i + by, shape.columns); column >= 0)
            visit(j * shape.columns + column);
    for (const Index by : {-1, 1})
        if (const Index row = beside(j + by, shape.rows); row >= 0 && shape.rows > 1)
            visit(row * shape.columns + i);
}

/// Contact spots: groups of nodes in contact that are connected by neighbours along x or y; runs on a line.
/// Returns the number of nodes of each, the largest first. `contact` are the nodes that touch, in any order.
/// If `periodic`, opposite ends of the grid are neighbours.
std::vector<Index> contact_spots(const std::vector<int>& contact, Extent shape, bool periodic);

/// Pressure and gap between a surface and the body at one load step, along a profile or at a map's nodes.
struct Interface {
    Eigen::VectorXd pressure; ///< at every node, MPa; 0 off contact
    Eigen::VectorXd gap;      ///< between the deformed body and the surface, mm; about 0 in contact
    Index spots = 0;          ///< number of contact spots; periodic bodies join the ends
    double widest = 0;        ///< largest spot, mm: its nodes times their spacing; for a map its size, mm^2
};

/// The interface at a load step of solve_contact, with its state, for the same profile and body. The gap is u
/// - (Delta - g0), with u by an FFT of the pressures. The body is completed for the surface's length.
Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step,
                       const ContactState& state);

} // namespace rough
