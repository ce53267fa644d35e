#include "domain/scan/points.hpp"

#include "domain/errors.hpp"
#include "domain/text/lines.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

void refuse_missing(const Points& points, const std::string& file) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isnan(points.x[i]) || std::isnan(points.heights[i]))
            throw InputError(at(file, points.line[i]) + ": a missing value, expected " +
                                 (std::isnan(points.x[i]) ? "an x" : "a height") +
                                 ", or to fill it by interpolation",
                             "fill");
}

Filled filled(const Points& points) {
    std::vector<std::size_t> with_x;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isnan(points.x[i]))
            with_x.push_back(i);
    const auto measured = [&](std::size_t i) { return !std::isnan(points.heights[i]); };
    const auto first = std::find_if(with_x.begin(), with_x.end(), measured);
    const auto end = std::find_if(with_x.rbegin(), std::make_reverse_iterator(first), measured).base();

    Filled result;
    std::size_t left = 0;
    for (auto i = first; i != end; ++i) {
        double height = points.heights[*i];
        if (measured(*i)) {
            left = *i;
        } else {
            const std::size_t right = *std::find_if(i, end, measured);
            const double run = points.x[right] - points.x[left];
            const double share = run != 0 ? (points.x[*i] - points.x[left]) / run : 0.5;
            height = points.heights[left] + share * (points.heights[right] - points.heights[left]);
            ++result.filled;
        }
        result.points.x.push_back(points.x[*i]);
        result.points.heights.push_back(height);
        result.points.last_digit.push_back(points.last_digit[*i]);
        result.points.line.push_back(points.line[*i]);
    }
    result.left_out = points.size() - result.points.size();
    return result;
}

Points reversed(Points points) {
    const auto reverse = [](auto& list) { std::reverse(list.begin(), list.end()); };
    reverse(points.x), reverse(points.heights), reverse(points.last_digit), reverse(points.line);
    return points;
}

} // namespace rough
