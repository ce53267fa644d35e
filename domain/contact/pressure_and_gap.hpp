#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// Calls visit(node) for each neighbour of a node along x, then along y (on an area, rows > 1). If
/// `periodic`, the grid is its own neighbour beyond its ends.
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

/// Contact spots: nodes in contact that are neighbours along x or y, directly or by way of others. Returns
/// how many nodes each has, the largest first. `contact` are the nodes that touch, in any order, of a grid
/// that is its own neighbour beyond its ends where it is `periodic`. On a line, its runs.
std::vector<Index> contact_spots(const std::vector<int>& contact, Extent shape, bool periodic);

/// What a surface and the body do to each other at one load step: along a profile, or at an area's nodes.
struct Interface {
    Eigen::VectorXd pressure; ///< at every node, MPa; 0 off contact
    Eigen::VectorXd gap;      ///< between the deformed body and the surface, mm; about 0 in contact
    Index spots = 0;          ///< of neighbouring contact nodes; periodic bodies join the ends
    double widest = 0;        ///< spot, mm: its nodes times their spacing; of an area its size, mm^2
};

/// The interface at a load step that solve_contact gave of the profile on this body, with its state: the
/// pressures, and the gap u - (Delta - g0) by an FFT of them. The body is completed for the surface's length.
Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step,
                       const ContactState& state);

} // namespace rough
