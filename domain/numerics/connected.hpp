#pragma once

#include "domain/numerics/grid.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace rough {

/// Calls visit(node) for each neighbour of a node along x, then, if there are several rows, along y. If
/// `periodic`, opposite ends of the grid are neighbours.
template <class Visit>
void each_neighbour(Index node, Extent shape, bool periodic, Visit visit) {
    const auto beside = [&](Index at, Index count) { return periodic ? (at + count) % count : at < count ? at : -1; };
    const Index i = node % shape.columns, j = node / shape.columns;
    for (const Index by : {-1, 1})
        if (const Index column = beside(i + by, shape.columns); column >= 0) visit(j * shape.columns + column);
    for (const Index by : {-1, 1})
        if (const Index row = beside(j + by, shape.rows); row >= 0 && shape.rows > 1) visit(row * shape.columns + i);
}

/// Calls visit(group) for each group of nodes. The nodes of a group, a std::vector<Index>, are connected along x
/// or y; on a line a group is a run of nodes. `nodes` are indices in any order, with or without repetitions. If
/// `periodic`, opposite ends of the grid are neighbours.
template <class Nodes, class Visit>
void each_group(const Nodes& nodes, Extent shape, bool periodic, Visit visit) {
    std::vector<char> waiting(static_cast<std::size_t>(shape.nodes()), 0);
    for (const auto node : nodes) waiting[static_cast<std::size_t>(node)] = 1;
    std::vector<Index> reached;
    const auto reach = [&](Index node) {
        if (std::exchange(waiting[static_cast<std::size_t>(node)], 0)) reached.push_back(node);
    };
    for (const auto first : nodes) {
        reached.clear();
        reach(first);
        for (std::size_t k = 0; k < reached.size(); ++k) each_neighbour(reached[k], shape, periodic, reach);
        if (!reached.empty()) visit(std::as_const(reached));
    }
}

/// The sizes of groups as each_group() finds them, in nodes, the largest first.
template <class Nodes>
std::vector<Index> group_sizes(const Nodes& nodes, Extent shape, bool periodic) {
    std::vector<Index> sizes;
    each_group(nodes, shape, periodic, [&](const auto& group) { sizes.push_back(static_cast<Index>(group.size())); });
    std::sort(sizes.begin(), sizes.end(), std::greater<>());
    return sizes;
}

} // namespace rough
