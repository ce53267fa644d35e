#include "domain/profile/outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rough {
namespace {

constexpr Index side = 7, fewest_aside = 3, fewest = 16, around = 12;

template <class Iterator>
double middle(Iterator first, Iterator end) {
    const Iterator half = first + (end - first) / 2;
    std::nth_element(first, half, end);
    return *half;
}

/// The range of what the nodes on one side foretell of a node: `step` is -1 for the left, 1 for the right.
std::pair<double, double> foretold(const Eigen::VectorXd& heights, Index node, Index step) {
    const Index count = std::min(side, step < 0 ? node : heights.size() - 1 - node);
    std::array<double, side> z;
    std::array<double, side*(side - 1) / 2> slopes;
    auto slope = slopes.begin();
    for (Index i = 0; i < count; ++i) {
        z[static_cast<std::size_t>(i)] = heights[node + step * (i + 1)];
        for (Index j = 0; j < i; ++j)
            *slope++ = (z[static_cast<std::size_t>(i)] - z[static_cast<std::size_t>(j)]) /
                       static_cast<double>(i - j);
    }
    const double steepness = middle(slopes.begin(), slope);
    std::array<double, side> line;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        line[i] = z[i] - steepness * static_cast<double>(i + 1);
    return std::minmax({middle(z.begin(), z.begin() + count), middle(line.begin(), line.begin() + count)});
}

/// The median step between neighbours around a node.
double usual_step(const std::vector<double>& steps, Index node) {
    const Index count = static_cast<Index>(steps.size());
    const Index first = std::max<Index>(0, std::min(node - around, count - 2 * around));
    std::vector<double> near(steps.begin() + first, steps.begin() + std::min(first + 2 * around, count));
    return middle(near.begin(), near.end());
}

} // namespace

std::vector<Index> outliers(const Eigen::VectorXd& heights) {
    const Index nodes = heights.size();
    if (nodes < fewest)
        return {};
    std::vector<double> steps(static_cast<std::size_t>(nodes - 1));
    for (Index i = 1; i < nodes; ++i)
        steps[static_cast<std::size_t>(i - 1)] = std::abs(heights[i] - heights[i - 1]);
    std::vector<double> in_order = steps;
    const double usual = middle(in_order.begin(), in_order.end()),
                 range = heights.maxCoeff() - heights.minCoeff();
    double resolved = range;
    for (const double step : steps)
        if (step > 1e-9 * range)
            resolved = std::min(resolved, step);

    std::vector<Index> found;
    for (Index i = fewest_aside; i < nodes - fewest_aside; ++i) {
        const auto left = foretold(heights, i, -1), right = foretold(heights, i, 1);
        const double beyond = std::max(heights[i] - std::max(left.second, right.second),
                                       std::min(left.first, right.first) - heights[i]);
        if (beyond > 6 * usual && beyond > 3 * resolved && beyond > 6 * usual_step(steps, i))
            found.push_back(i);
    }
    return found;
}

Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes) {
    for (std::size_t at = 0; at < nodes.size();) {
        std::size_t end = at + 1; // of a run
        while (end < nodes.size() && nodes[end] == nodes[end - 1] + 1)
            ++end;
        const Index left = nodes[at] - 1, right = nodes[end - 1] + 1;
        if (left < 0 && right == heights.size())
            break;
        const double from = heights[left < 0 ? right : left],
                     to = heights[right == heights.size() ? left : right];
        for (; at < end; ++at)
            heights[nodes[at]] = from + (to - from) * static_cast<double>(nodes[at] - left) /
                                            static_cast<double>(right - left);
    }
    return heights;
}

} // namespace rough
