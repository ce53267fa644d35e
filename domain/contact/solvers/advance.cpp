#include "domain/contact/solvers/advance.hpp"

namespace rough {
namespace {

/// A new summit touches at the nodes that penetrate by more than this share of its greatest depth.
constexpr double new_summit_share = 0.6;
/// Value of Doubt::edge if no edge of contact is near.
constexpr double far = 2;

struct Doubt {
    double edge;    ///< 0: sure to stay in contact, 1: as likely to be dropped; `far` in a run without a contact
                    ///< at its ends
    double deepest; ///< depth in the run
};

/// Assesses a run of penetrating nodes along a line of n nodes, `stride` apart. The run begins at number
/// `place` of the line, node `first`. Calls note(node, doubt); returns the number of its nodes.
template <class Penetrates, class Touches, class Note>
Index assess_run(const Eigen::ArrayXd& depth, Index first, Index stride, Index place, Index n, Penetrates penetrates,
                 Touches touches, Note note) {
    Index count = 1;
    double deepest = depth[first];
    for (; place + count < n && penetrates(first + count * stride); ++count)
        deepest = std::max(deepest, depth[first + count * stride]);
    const bool left = place > 0 && touches(first - stride),
               right = place + count < n && touches(first + count * stride);
    const double length = static_cast<double>(count), advance = (2 * length + 2) / 3;
    for (Index i = 0; i < count; ++i) {
        const double from_left = static_cast<double>(i), from_right = static_cast<double>(count - 1 - i);
        const double share = left && right ? std::min(from_left, from_right) / length
                             : left        ? from_left / advance
                             : right       ? from_right / advance
                                           : far;
        note(first + i * stride, Doubt{share, deepest});
    }
    return count;
}

} // namespace

std::vector<int> advancing_nodes(const Eigen::ArrayXd& depth, const std::vector<char>& touching, Extent shape,
                                 double min_depth, Team& team) {
    auto touches = [&](Index i) { return touching[static_cast<std::size_t>(i)] != 0; };
    auto penetrates = [&](Index i) { return depth[i] > min_depth && !touches(i); };
    const std::vector<int> deep = team.where(depth.size(), penetrates);
    std::vector<std::pair<double, int>> found;
    const auto take = [&](Index i, const Doubt& doubt) {
        const double share = doubt.edge < far ? doubt.edge : (1 - depth[i] / doubt.deepest) / (1 - new_summit_share);
        if (share < 1) found.emplace_back(share, static_cast<int>(i));
    };
    const Index columns = shape.columns;
    const bool area = shape.rows > 1;
    std::vector<Doubt> along_y(area ? deep.size() : 0);
    const auto of_y = [&](Index i) -> Doubt& {
        return along_y[static_cast<std::size_t>(std::lower_bound(deep.begin(), deep.end(), i) - deep.begin())];
    };
    if (area)
        for (const Index i : deep) // starting at the first node of each run
            if (i < columns || !penetrates(i - columns))
                assess_run(depth, i, columns, i / columns, shape.rows, penetrates, touches,
                           [&](Index k, const Doubt& doubt) { of_y(k) = doubt; });
    for (const Index i : deep)
        if (i % columns == 0 || !penetrates(i - 1))
            assess_run(depth, i, 1, i % columns, columns, penetrates, touches, [&](Index k, const Doubt& along_x) {
                if (!area) return take(k, along_x);
                const Doubt& other = of_y(k);
                take(k, {std::min(along_x.edge, other.edge), std::max(along_x.deepest, other.deepest)});
            });
    std::sort(found.begin(), found.end());
    std::vector<int> nodes;
    for (const auto& entry : found) nodes.push_back(entry.second);
    return nodes;
}

} // namespace rough
