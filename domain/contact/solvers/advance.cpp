#include "domain/contact/solvers/advance.hpp"

#include <algorithm>

namespace rough {

namespace {

/// A summit that touches anew does so where it penetrates by this share of its greatest depth.
constexpr double new_summit_share = 0.6;

} // namespace

std::vector<int> advancing_nodes(const Eigen::ArrayXd& depth, const std::vector<char>& touching,
                                 double least) {
    auto touches = [&](Index i) { return touching[static_cast<std::size_t>(i)] != 0; };
    auto penetrates = [&](Index i) { return depth[i] > least && !touches(i); };
    std::vector<std::pair<double, int>> doubt; // 0: sure to stay in contact, 1: as likely to be dropped
    const Index n = depth.size();
    for (Index first = 0; first < n; ++first) {
        if (!penetrates(first))
            continue;
        Index last = first;
        double deepest = depth[first];
        while (last + 1 < n && penetrates(last + 1))
            deepest = std::max(deepest, depth[++last]);
        const bool left = first > 0 && touches(first - 1), right = last + 1 < n && touches(last + 1);
        const double length = static_cast<double>(last - first + 1), advance = (2 * length + 2) / 3;
        for (Index i = first; i <= last; ++i) {
            const double from_left = static_cast<double>(i - first),
                         from_right = static_cast<double>(last - i);
            const double share = left && right ? std::min(from_left, from_right) / length
                                 : left        ? from_left / advance
                                 : right       ? from_right / advance
                                               : (1 - depth[i] / deepest) / (1 - new_summit_share);
            if (share < 1)
                doubt.emplace_back(share, static_cast<int>(i));
        }
        first = last;
    }
    std::sort(doubt.begin(), doubt.end());
    std::vector<int> nodes;
    for (const auto& entry : doubt)
        nodes.push_back(entry.second);
    return nodes;
}

} // namespace rough
