#include "domain/profile/outliers.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace rough {
namespace {

constexpr Index min_profile_nodes = 16, around = 12;
constexpr std::size_t side = 7; ///< nodes that predict, on either side
constexpr Index min_aside = 3;
/// Median steps by which a particle stands out, and by which its flanks do.
constexpr double particle_steps = 6, flank_steps = 3;

template <class Iterator>
double middle(Iterator first, Iterator end) {
    const Iterator half = first + (end - first) / 2;
    std::nth_element(first, half, end);
    return *half;
}

/// A node's height as the nodes on one side predict it: their median, and their line of median slope.
struct Predicted {
    double median, line;
};
/// Predicts a node's height from its left (`step` -1) or right (1); nothing with fewer than three nodes that
/// are not outliers.
std::optional<Predicted> predicted(const Eigen::VectorXd& heights, Index node, Index step,
                                   const std::vector<bool>& is_outlier) {
    std::array<double, side> z, line, distance;
    std::array<double, side*(side - 1) / 2> slopes;
    auto slope = slopes.begin();
    std::size_t count = 0;
    for (Index at = node + step; at >= 0 && at < heights.size() && count < side; at += step) {
        if (is_outlier[static_cast<std::size_t>(at)])
            continue;
        z[count] = heights[at], distance[count] = static_cast<double>(std::abs(at - node));
        for (std::size_t j = 0; j < count; ++j)
            *slope++ = (z[count] - z[j]) / (distance[count] - distance[j]);
        ++count;
    }
    if (count < static_cast<std::size_t>(min_aside))
        return std::nullopt;
    const double steepness = middle(slopes.begin(), slope);
    for (std::size_t i = 0; i < count; ++i)
        line[i] = z[i] - steepness * distance[i];
    const auto end = static_cast<std::ptrdiff_t>(count);
    return Predicted{middle(z.begin(), z.begin() + end), middle(line.begin(), line.begin() + end)};
}

/// The median step between neighbours near this node.
double usual_step(const Eigen::VectorXd& steps, Index node) {
    const Index first = std::max<Index>(0, std::min(node - around, steps.size() - 2 * around));
    Eigen::VectorXd near = steps.segment(first, std::min(2 * around, steps.size() - first));
    return middle(near.begin(), near.end());
}

} // namespace

std::vector<Index> outliers(const Eigen::VectorXd& heights) {
    const Index nodes = heights.size();
    if (nodes < min_profile_nodes)
        return {};
    const Eigen::VectorXd steps = (heights.tail(nodes - 1) - heights.head(nodes - 1)).cwiseAbs();
    Eigen::VectorXd in_order = steps;
    const double usual = middle(in_order.begin(), in_order.end()),
                 range = heights.maxCoeff() - heights.minCoeff();
    double resolved = range;
    for (const double step : steps)
        if (step > 1e-9 * range)
            resolved = std::min(resolved, step);

    std::vector<bool> is_outlier(static_cast<std::size_t>(nodes), false);
    // 1 if the node stands out above its neighbours, -1 below, else 0. Flanks are compared only with the
    // lines, because medians on a slope would hide them.
    const auto stands_out = [&](Index i, bool is_flank) {
        const auto left = predicted(heights, i, -1, is_outlier), right = predicted(heights, i, 1, is_outlier);
        if (!left || !right)
            return 0;
        auto [lowest, highest] = std::minmax({left->line, right->line});
        if (!is_flank)
            std::tie(lowest, highest) = std::minmax({lowest, highest, left->median, right->median});
        const double beyond = std::max(heights[i] - highest, lowest - heights[i]),
                     times = is_flank ? flank_steps : particle_steps;
        if (beyond > times * usual && beyond > 3 * resolved && beyond > times * usual_step(steps, i))
            return heights[i] > highest ? 1 : -1;
        return 0;
    };
    std::vector<std::pair<Index, int>> inner;
    for (Index i = min_aside; i < nodes - min_aside; ++i)
        if (const int side = stands_out(i, false))
            inner.emplace_back(i, side);
    // A particle's outer nodes and flanks look like a step as long as its inner nodes predict their heights.
    for (const auto& [node, side] : inner)
        is_outlier[static_cast<std::size_t>(node)] = true;
    for (const auto& [node, side] : inner)
        for (const Index step : {-1, 1})
            for (Index i = node + step; i >= min_aside && i < nodes - min_aside; i += step)
                if (!is_outlier[static_cast<std::size_t>(i)]) {
                    if (stands_out(i, true) != side)
                        break;
                    is_outlier[static_cast<std::size_t>(i)] = true;
                }
    std::vector<Index> found;
    for (Index i = 0; i < nodes; ++i)
        if (is_outlier[static_cast<std::size_t>(i)])
            found.push_back(i);
    return found;
}

Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes) {
    for (std::size_t at = 0; at < nodes.size();) {
        std::size_t end = at + 1; // after a run of nodes
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
