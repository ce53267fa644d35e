#pragma once

#include "ga/base/random.hpp"
#include "ga/problem/ranking.hpp"

namespace ga {

/// The volume above `reference` that the points dominate; higher is better in every objective (Zitzler and
/// Thiele 1998). Only points above it in all objectives count. Slices one objective after the other (While et
/// al. 2006), in n log n for two objectives and n times as long for each further one.
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

/// The share of a fixed sample of 4096 points that the points dominate. It estimates the hypervolume for many
/// objectives, with less weight far from `reference` (Zitzler, Brockhoff and Thiele 2007). A coordinate of
/// the sample is the reference's plus width u/(1 - u), u uniform in (0, 1).
inline double dominated_share(const std::vector<Point>& points, const Point& reference, const Point& width) {
    constexpr int count = 4096;
    Stream stream(reference.size());
    int dominated = 0;
    Point sample(reference.size());
    for (int i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < sample.size(); ++k) {
            const double u = stream.uniform();
            sample[k] = reference[k] + width[k] * u / (1 - u);
        }
        dominated += std::any_of(points.begin(), points.end(), [&](const Point& point) {
            for (std::size_t k = 0; k < sample.size(); ++k)
                if (!(point[k] >= sample[k]))
                    return false;
            return true;
        });
    }
    return static_cast<double>(dominated) / count;
}

} // namespace ga
