#include "domain/contact/solvers/advance.hpp"

#include <algorithm>

namespace rough {

namespace {

/// A summit that touches anew does so where it penetrates by this share of its greatest depth.
constexpr double new_summit_share = 0.6;
/// Of a node that no contact's edge nears.
constexpr double far = 2;

struct Doubt {
    double edge;    ///< 0: sure to stay in contact, 1: as likely to be dropped; `far` in a run of its own
    double deepest; ///< depth in the run
};

/// Judges the penetrating nodes of one line, `stride` apart; calls judge(node, doubt).
template <class Penetrates, class Touches, class Judge>
void judge_line(const Eigen::ArrayXd& depth, Index from, Index stride, Index n, Penetrates penetrates,
                Touches touches, Judge judge) {
    for (Index first = 0; first < n; ++first) {
        const auto node = [&](Index i) { return from + i * stride; };
        if (!penetrates(node(first)))
            continue;
        Index last = first;
        double deepest = depth[node(first)];
        while (last + 1 < n && penetrates(node(last + 1)))
            deepest = std::max(deepest, depth[node(++last)]);
        const bool left = first > 0 && touches(node(first - 1)),
                   right = last + 1 < n && touches(node(last + 1));
        const double length = static_cast<double>(last - first + 1), advance = (2 * length + 2) / 3;
        for (Index i = first; i <= last; ++i) {
            const double from_left = static_cast<double>(i - first),
                         from_right = static_cast<double>(last - i);
            const double share = left && right ? std::min(from_left, from_right) / length
                                 : left        ? from_left / advance
                                 : right       ? from_right / advance
                                               : far;
            judge(node(i), Doubt{share, deepest});
        }
        first = last;
    }
}

} // namespace

std::vector<int> advancing_nodes(const Eigen::ArrayXd& depth, const std::vector<char>& touching, Extent shape,
                                 double least) {
    auto touches = [&](Index i) { return touching[static_cast<std::size_t>(i)] != 0; };
    auto penetrates = [&](Index i) { return depth[i] > least && !touches(i); };
    std::vector<std::pair<double, int>> found;
    const auto take = [&](Index i, const Doubt& doubt) {
        const double share =
            doubt.edge < far ? doubt.edge : (1 - depth[i] / doubt.deepest) / (1 - new_summit_share);
        if (share < 1)
            found.emplace_back(share, static_cast<int>(i));
    };
    if (shape.rows == 1) {
        judge_line(depth, 0, 1, shape.columns, penetrates, touches, take);
    } else {
        std::vector<Doubt> along_y(static_cast<std::size_t>(depth.size()));
        for (Index i = 0; i < shape.columns; ++i)
            judge_line(depth, i, shape.columns, shape.rows, penetrates, touches,
                       [&](Index k, const Doubt& doubt) { along_y[static_cast<std::size_t>(k)] = doubt; });
        for (Index j = 0; j < shape.rows; ++j)
            judge_line(
                depth, j * shape.columns, 1, shape.columns, penetrates, touches,
                [&](Index k, const Doubt& along_x) {
                    const Doubt& other = along_y[static_cast<std::size_t>(k)];
                    take(k, {std::min(along_x.edge, other.edge), std::max(along_x.deepest, other.deepest)});
                });
    }
    std::sort(found.begin(), found.end());
    std::vector<int> nodes;
    for (const auto& entry : found)
        nodes.push_back(entry.second);
    return nodes;
}

} // namespace rough
