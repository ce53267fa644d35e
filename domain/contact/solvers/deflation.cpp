#include "domain/contact/solvers/deflation.hpp"

#include <algorithm>

namespace rough {

namespace {

constexpr Index most_columns = 64;

/// Half-open ranges of positions in `nodes` whose nodes are neighbours.
std::vector<std::pair<Index, Index>> runs_of(const std::vector<int>& nodes) {
    std::vector<std::pair<Index, Index>> runs;
    const Index count = static_cast<Index>(nodes.size());
    for (Index first = 0; first < count;) {
        Index last = first + 1;
        while (last < count &&
               nodes[static_cast<std::size_t>(last)] == nodes[static_cast<std::size_t>(last - 1)] + 1)
            ++last;
        runs.emplace_back(first, last);
        first = last;
    }
    return runs;
}

} // namespace

Eigen::VectorXd cumulative(const Eigen::VectorXd& column) {
    const Index n = column.size();
    Eigen::VectorXd sums(2 * n);
    double sum = sums[0] = 0;
    for (Index k = 1; k < 2 * n; ++k)
        sums[k] = sum += column[std::abs(k - n)];
    return sums;
}

Deflation::Deflation(const std::vector<int>& nodes, const Eigen::VectorXd& sums) {
    const auto runs = sums.size() > 0 ? runs_of(nodes) : std::vector<std::pair<Index, Index>>();
    const Index count = static_cast<Index>(nodes.size()), many = static_cast<Index>(runs.size());
    const Index columns = std::min(most_columns, many), n = sums.size() / 2;
    const auto node = [&](Index k) { return static_cast<Index>(nodes[static_cast<std::size_t>(k)]); };
    image_.resize(count, columns);
    for (Index run = 0; run < many; ++run) {
        const auto [begin, end] = runs[static_cast<std::size_t>(run)];
        const Index target = run * columns / many;
        if (target == static_cast<Index>(begins_.size())) {
            begins_.push_back(begin);
            image_.col(target).setZero();
        }
        // The sum of h_|i - j| over the run's j is that from i - last to i - first.
        const Index first = node(begin), last = node(end - 1);
        for (const auto& [from, to] : runs) {
            const Index length = to - from, i = node(from) + n;
            image_.col(target).segment(from, length) +=
                sums.segment(i - first, length) - sums.segment(i - last - 1, length);
        }
    }
    begins_.push_back(count);
    Eigen::MatrixXd energy(columns, columns);
    for (Index c = 0; c < columns; ++c)
        energy.row(c) =
            image_
                .middleRows(begins_[static_cast<std::size_t>(c)],
                            begins_[static_cast<std::size_t>(c + 1)] - begins_[static_cast<std::size_t>(c)])
                .colwise()
                .sum();
    if (columns > 0)
        energy_.compute(energy);
    usable_ = columns > 0 && energy_.info() == Eigen::Success;
}

Eigen::VectorXd Deflation::reduced(const Eigen::VectorXd& v) const {
    Eigen::VectorXd sums(image_.cols());
    for (Index c = 0; c < sums.size(); ++c) {
        const Index begin = begins_[static_cast<std::size_t>(c)],
                    end = begins_[static_cast<std::size_t>(c + 1)];
        sums[c] = v.segment(begin, end - begin).sum();
    }
    return sums;
}

void Deflation::subtract(const Eigen::VectorXd& c, Eigen::VectorXd& v) const {
    for (Index k = 0; k < c.size(); ++k) {
        const Index begin = begins_[static_cast<std::size_t>(k)],
                    end = begins_[static_cast<std::size_t>(k + 1)];
        v.segment(begin, end - begin).array() -= c[k];
    }
}

Eigen::VectorXd Deflation::project(Eigen::VectorXd& residual) const {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(residual.size());
    if (usable_) {
        const Eigen::VectorXd c = energy_.solve(reduced(residual));
        subtract(-c, change);
        residual.noalias() -= image_ * c;
    }
    return change;
}

void Deflation::purge(Eigen::VectorXd& z) const {
    if (usable_)
        subtract(energy_.solve(image_.transpose() * z), z);
}

} // namespace rough
