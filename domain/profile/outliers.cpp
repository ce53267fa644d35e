#include "domain/profile/outliers.hpp"

#include "domain/numerics/connected.hpp"

#include <array>
#include <cmath>
#include <tuple>

namespace rough {
namespace {

constexpr Index min_profile_nodes = 16, around = 12;
constexpr std::size_t side = 7; ///< nodes that predict, on either side
constexpr Index min_aside = 3;
constexpr double max_share = 0.02; ///< share of a map's nodes above which they are its texture
constexpr Index max_extent = 8; ///< largest extent of a particle on a map along x and along y, with its flanks, nodes
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
/// Predicts a node's height from its left (`step` -1) or right (1). The outermost `min_aside` nodes are
/// tested otherwise, so that either side has nodes that predict.
Predicted predicted(const Eigen::VectorXd& heights, Index node, Index step, const Eigen::VectorXi& side_of) {
    std::array<double, side> z, line, distance;
    std::array<double, side*(side - 1) / 2> slopes;
    auto slope = slopes.begin();
    std::size_t count = 0;
    for (Index at = node + step; at >= 0 && at < heights.size() && count < side; at += step) {
        if (side_of[at] != 0) continue;
        z[count] = heights[at], distance[count] = static_cast<double>(std::abs(at - node));
        for (std::size_t j = 0; j < count; ++j) *slope++ = (z[count] - z[j]) / (distance[count] - distance[j]);
        ++count;
    }
    const double steepness = middle(slopes.begin(), slope);
    for (std::size_t i = 0; i < count; ++i) line[i] = z[i] - steepness * distance[i];
    const auto end = static_cast<std::ptrdiff_t>(count);
    return {middle(z.begin(), z.begin() + end), middle(line.begin(), line.begin() + end)};
}

/// The median step between neighbours near this node.
double usual_step(const Eigen::VectorXd& steps, Index node) {
    const Index first = std::max<Index>(0, std::min(node - around, steps.size() - 2 * around));
    Eigen::VectorXd near = steps.segment(first, std::min(2 * around, steps.size() - first));
    return middle(near.begin(), near.end());
}

/// The step between the levels of heights that were digitised, and perhaps levelled afterwards, from their
/// second differences; 0 without levels. A removed line changes all steps, but no second difference. So these
/// are near multiples of the step, of which many are 0 and many are not.
double digital_step(Eigen::VectorXd bends) {
    const Index n = bends.size();
    std::sort(bends.begin(), bends.end());
    constexpr double gap = 20, near = 0.1, least_share = 0.05;
    const auto least = static_cast<Index>(std::ceil(least_share * static_cast<double>(n)));
    for (Index k = n - least; k >= least; --k)
        if (bends[k] > gap * bends[k - 1]) {
            const Index past = std::upper_bound(bends.begin() + k, bends.end(), 1.5 * bends[k]) - bends.begin();
            const double step = bends.segment(k, past - k).mean();
            const Eigen::ArrayXd levels = bends.tail(n - k).array() / step;
            return (levels > 1 / near || (levels - levels.round()).abs() <= near).all() ? step : 0;
        }
    return 0;
}

/// The sides of the outliers of one line. The median step of all lines is `usual`; their resolution is `resolved`.
Eigen::VectorXi sides_of_outliers(const Eigen::VectorXd& heights, const Eigen::VectorXd& steps, double usual,
                                  double resolved) {
    const Index nodes = heights.size();
    Eigen::VectorXi side_of = Eigen::VectorXi::Zero(nodes);
    // 1 if the node stands out above its neighbours, -1 below, else 0. Flanks are compared only with the
    // lines, because medians on a slope would hide them.
    const auto stands_out = [&](Index i, bool is_flank) {
        const auto left = predicted(heights, i, -1, side_of), right = predicted(heights, i, 1, side_of);
        auto [lowest, highest] = std::minmax({left.line, right.line});
        if (!is_flank) std::tie(lowest, highest) = std::minmax({lowest, highest, left.median, right.median});
        const double beyond = std::max(heights[i] - highest, lowest - heights[i]),
                     times = is_flank ? flank_steps : particle_steps;
        if (beyond > times * usual && beyond > 3 * resolved && beyond > times * usual_step(steps, i))
            return heights[i] > highest ? 1 : -1;
        return 0;
    };
    std::vector<std::pair<Index, int>> inner;
    for (Index i = min_aside; i < nodes - min_aside; ++i)
        if (const int side = stands_out(i, false)) inner.emplace_back(i, side);
    // A particle's outer nodes and flanks look like a step as long as its inner nodes predict their heights.
    for (const auto& [node, side] : inner) side_of[node] = side;
    for (const auto& [node, side] : inner)
        for (const Index step : {-1, 1})
            for (Index i = node + step; i >= min_aside && i < nodes - min_aside; i += step)
                if (int& at = side_of[i]; at == 0) {
                    if (stands_out(i, true) != side) break;
                    at = side;
                }
    // A node at an end has few neighbours on one side. It is an outlier if it is as far from all other
    // heights as these are from each other.
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (Index i = min_aside; i < nodes - min_aside; ++i)
        if (side_of[i] == 0) lowest = std::min(lowest, heights[i]), highest = std::max(highest, heights[i]);
    for (Index i = 0; i < nodes; i = i + 1 == min_aside ? nodes - min_aside : i + 1) {
        const double beyond = std::max(heights[i] - highest, lowest - heights[i]);
        if (beyond > highest - lowest && beyond > 3 * resolved &&
            beyond > 2 * particle_steps * std::max(usual, usual_step(steps, i)))
            side_of[i] = heights[i] > highest ? 1 : -1;
    }
    return side_of;
}

/// For each node of the lines 1 if it is an outlier above its line, -1 below, else 0. Each column is a line.
Eigen::MatrixXi sides_of_outliers(const Eigen::MatrixXd& lines) {
    const Index nodes = lines.rows();
    Eigen::MatrixXi sides = Eigen::MatrixXi::Zero(nodes, lines.cols());
    if (nodes < min_profile_nodes) return sides;
    const Eigen::MatrixXd all_steps = (lines.bottomRows(nodes - 1) - lines.topRows(nodes - 1)).cwiseAbs();
    Eigen::VectorXd in_order = all_steps.reshaped();
    const double usual = middle(in_order.begin(), in_order.end()), range = lines.maxCoeff() - lines.minCoeff();
    const Eigen::MatrixXd bends =
        (lines.topRows(nodes - 2) - 2 * lines.middleRows(1, nodes - 2) + lines.bottomRows(nodes - 2)).cwiseAbs();
    const double resolved = std::max((all_steps.array() > 1e-9 * range).select(all_steps.array(), range).minCoeff(),
                                     digital_step(bends.reshaped()));
    for (Index line = 0; line < lines.cols(); ++line)
        sides.col(line) = sides_of_outliers(lines.col(line), all_steps.col(line), usual, resolved);
    return sides;
}

} // namespace

std::vector<Index> outliers(const Profile& surface) {
    const auto [columns, rows] = surface.shape();
    const Eigen::MatrixXd z = surface.heights.reshaped(columns, rows);
    const Eigen::MatrixXi along_x = sides_of_outliers(z), along_y = sides_of_outliers(z.transpose()).transpose();
    std::vector<Index> standing, found;
    for (Index node = 0; node < surface.nodes(); ++node)
        if (along_x(node) != 0 || along_y(node) != 0) standing.push_back(node);
    if (!surface.is_2d()) return standing;

    std::vector<Index> around = standing; // with neighbours, which join nodes that meet at corners
    for (const Index node : standing)
        each_neighbour(node, surface.shape(), false, [&](Index other) { around.push_back(other); });
    // Scratches and ridges stand out, too. But they are long, or the nodes next to those found are as high.
    each_group(around, surface.shape(), false, [&, wide = columns, high = rows](const std::vector<Index>& group) {
        const auto extent = [&](auto coordinate) {
            const auto [first, last] = std::ranges::minmax(group, {}, coordinate);
            return std::pair(coordinate(first), coordinate(last) + 1);
        };
        const auto [left, right] = extent([&](Index node) { return node % wide; });
        const auto [below, above] = extent([&](Index node) { return node / wide; });
        if (std::max(right - left, above - below) > max_extent + 2) return; // with the neighbours
        const Index x = std::max<Index>(0, left - max_extent), y = std::max<Index>(0, below - max_extent);
        Eigen::VectorXd near =
            z.block(x, y, std::min(wide, right + max_extent) - x, std::min(high, above + max_extent) - y).reshaped();
        const double base = middle(near.begin(), near.end());
        for (const int side : {-1, 1}) {
            double top = -std::numeric_limits<double>::infinity(), beside = top;
            const auto is_found = [&](Index node) { return along_x(node) == side && along_y(node) == side; };
            for (const Index node : group) {
                double& highest = is_found(node) ? top : beside;
                highest = std::max(highest, side * z(node));
            }
            if (beside < (top + side * base) / 2) std::ranges::copy_if(group, std::back_inserter(found), is_found);
        }
    });
    if (static_cast<double>(found.size()) > max_share * static_cast<double>(surface.nodes())) return {};
    std::ranges::sort(found);
    return found;
}

} // namespace rough
