#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace ga {

/// The positions 0 to n-1 in the order of `before(a, b)`; ties in ascending order. The type of `before` is
/// erased, so that sorting is compiled only once.
inline std::vector<std::size_t> in_order(std::size_t n,
                                         const std::function<bool(std::size_t, std::size_t)>& before) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&before](std::size_t a, std::size_t b) { return before(a, b) || (a < b && !before(b, a)); });
    return order;
}

/// Values of several objectives, higher is better.
using Point = std::vector<double>;

/// Whether a is as good as b in every objective and better in one.
inline bool dominates(const Point& a, const Point& b) {
    bool better = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] < b[i])
            return false;
        better |= a[i] > b[i];
    }
    return better;
}

/// The number of the front of each point, from 0 (Deb, Pratap, Agarwal and Meyarivan 2002). After fronts 0 to
/// r-1 are removed, no point dominates a point of front r. Points are sorted so that no later point dominates
/// an earlier one. Each point is compared only with earlier points (Zhang, Tian, Cheng and Jin 2015).
inline std::vector<std::size_t> pareto_ranks(const std::vector<Point>& points) {
    const std::vector<std::size_t> order =
        in_order(points.size(), [&](std::size_t a, std::size_t b) { return points[a] > points[b]; });
    std::vector<std::vector<std::size_t>> fronts;
    std::vector<std::size_t> rank(points.size());
    for (const std::size_t each : order) {
        const auto free = std::partition_point(fronts.begin(), fronts.end(), [&](const auto& front) {
            return std::any_of(front.rbegin(), front.rend(),
                               [&](std::size_t other) { return dominates(points[other], points[each]); });
        });
        rank[each] = static_cast<std::size_t>(free - fronts.begin());
        if (free == fronts.end())
            fronts.push_back({each});
        else
            free->push_back(each);
    }
    return rank;
}

/// The crowding distance of each point in its front (Deb et al. 2002): the distance between its two
/// neighbours relative to the front's range, summed over objectives. It is infinite at the ends of a front.
inline std::vector<double> crowding_distances(const std::vector<Point>& points,
                                              const std::vector<std::size_t>& ranks) {
    std::vector<double> room(points.size(), 0);
    for (std::size_t k = 0; !points.empty() && k < points[0].size(); ++k) {
        const auto order = in_order(points.size(), [&](std::size_t a, std::size_t b) {
            return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : points[a][k] < points[b][k];
        });
        for (std::size_t first = 0, last; first < order.size(); first = last + 1) {
            last = first;
            while (last + 1 < order.size() && ranks[order[last + 1]] == ranks[order[first]])
                ++last;
            const double range = points[order[last]][k] - points[order[first]][k];
            room[order[first]] = room[order[last]] = HUGE_VAL;
            for (std::size_t i = first + 1; i < last && range > 0; ++i)
                room[order[i]] += (points[order[i + 1]][k] - points[order[i - 1]][k]) / range;
        }
    }
    return room;
}

} // namespace ga
