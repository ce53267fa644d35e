#include "domain/contact/deflation.hpp"

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
    Eigen::VectorXd sums(column.size());
    double sum = 0;
    for (Index k = 0; k < column.size(); ++k)
        sums[k] = sum += column[k];
    return sums;
}

Deflation::Deflation(const std::vector<int>& nodes, const Eigen::VectorXd& column,
                     const Eigen::VectorXd& sums) {
    const auto runs = runs_of(nodes);
    const Index count = static_cast<Index>(nodes.size()), many = static_cast<Index>(runs.size());
    const Index columns = std::min(most_columns, many);
    image_ = Eigen::MatrixXd::Zero(count, columns);
    for (Index run = 0; run < many; ++run) {
        const auto [begin, end] = runs[static_cast<std::size_t>(run)];
        const Index target = run * columns / many;
        if (target == static_cast<Index>(begins_.size()))
            begins_.push_back(begin);
        const Index first = nodes[static_cast<std::size_t>(begin)],
                    last = nodes[static_cast<std::size_t>(end - 1)];
        auto image = image_.col(target);
        for (Index k = 0; k < begin; ++k) {
            const Index i = nodes[static_cast<std::size_t>(k)];
            image[k] += sums[last - i] - sums[first - i - 1];
        }
        for (Index k = begin; k < end; ++k) {
            const Index i = nodes[static_cast<std::size_t>(k)];
            image[k] += sums[last - i] + sums[i - first] - column[0];
        }
        for (Index k = end; k < count; ++k) {
            const Index i = nodes[static_cast<std::size_t>(k)];
            image[k] += sums[i - first] - sums[i - last - 1];
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
    energy_.compute(energy);
    usable_ = energy_.info() == Eigen::Success;
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
