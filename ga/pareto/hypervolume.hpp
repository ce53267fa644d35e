#pragma once

#include "ga/pareto/ranking.hpp"

namespace ga {

/// How much of the space above `reference` the points dominate, greater is better in every objective (Zitzler
/// and Thiele 1998); points that are not above it in all objectives count nothing. By slicing one objective
/// after the other (While et al. 2006): n log n for two objectives, n times as much for each further one.
inline double hypervolume(std::vector<Point> points, const Point& reference) {
    const std::size_t last = reference.size() - 1;
    std::erase_if(points, [&](const Point& point) {
        for (std::size_t k = 0; k <= last; ++k)
            if (!(point[k] > reference[k]))
                return true;
        return false;
    });
    const auto order = in_order(
        points.size(), [&](std::size_t a, std::size_t b) { return points[a][last] > points[b][last]; });
    if (points.empty())
        return 0;
    if (last == 0)
        return points[order[0]][0] - reference[0];
    double volume = 0, widest = reference[0];
    std::vector<Point> above;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[order[i]];
        const double next = i + 1 < points.size() ? points[order[i + 1]][last] : reference[last];
        const double thickness = point[last] - next;
        if (last == 1) {
            widest = std::max(widest, point[0]);
            volume += thickness * (widest - reference[0]);
            continue;
        }
        above.push_back(point);
        above.back().pop_back();
        if (thickness > 0)
            volume += thickness * hypervolume(above, Point(reference.begin(), reference.end() - 1));
    }
    return volume;
}

} // namespace ga
