#include "domain/profile/filter.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"

#include <cmath>
#include <numeric>

namespace rough {
namespace {

/// A sequence's transform, padded with zeros.
Eigen::ArrayXcd transformed(const Eigen::VectorXd& values, Index length) {
    Eigen::ArrayXd padded = Eigen::ArrayXd::Zero(length);
    padded.head(values.size()) = values.array();
    return fourier_transform(padded);
}

/// sum_t weight_t z_(i+t) for each node i, t = -reach .. reach, from the transforms of the heights and of the
/// reversed weights.
Eigen::VectorXd correlated(const Eigen::ArrayXcd& heights, const Eigen::ArrayXcd& weights, Index reach,
                           Index nodes, Index length) {
    const Eigen::ArrayXd sums = inverse_fourier_transform(heights * weights, length);
    return sums.segment(reach, nodes).matrix() / static_cast<double>(length);
}

/// The filter for lines of one length.
class LineFilter {
  public:
    LineFilter(Index nodes, double spacing, double cut_off) : nodes_(nodes) {
        reach_ = static_cast<Index>(std::min(std::floor(cut_off / spacing), static_cast<double>(nodes - 1)));
        if (reach_ == 0)
            return;
        const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(2 * reach_ + 1, -1, 1); // x over reach * spacing
        const double share = static_cast<double>(reach_) * spacing / cut_off;
        const Eigen::ArrayXd weight = (-std::pow(M_PI * share, 2) / std::log(2.0) * t.square()).exp();
        // Moments of the weights inside the line, by running sums over t.
        const auto running = [](const Eigen::ArrayXd& values) {
            Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(values.size() + 1);
            std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
            return sums;
        };
        s0_ = running(weight), s1_ = running(weight * t), s2_ = running(weight * t.square());
        length_ = fast_fourier_length(nodes + 2 * reach_ + 1);
        weight_ = transformed(weight.reverse(), length_);
        moment_ = transformed((weight * t).reverse(), length_);
    }

    Eigen::VectorXd operator()(const Eigen::VectorXd& line) const {
        if (reach_ == 0)
            return line;
        const double mean = line.mean();
        const auto heights = transformed(line.array() - mean, length_);
        const Eigen::VectorXd t0 = correlated(heights, weight_, reach_, nodes_, length_),
                              t1 = correlated(heights, moment_, reach_, nodes_, length_);
        Eigen::VectorXd result(nodes_);
        for (Index i = 0; i < nodes_; ++i) {
            const Index first = std::max<Index>(reach_ - i, 0),
                        past = std::min(reach_ + nodes_ - i, 2 * reach_ + 1);
            const double m0 = s0_[past] - s0_[first], m1 = s1_[past] - s1_[first],
                         m2 = s2_[past] - s2_[first];
            result[i] = mean + (t0[i] * m2 - t1[i] * m1) / (m0 * m2 - m1 * m1);
        }
        return result;
    }

  private:
    Index nodes_, reach_, length_ = 0;
    Eigen::ArrayXd s0_, s1_, s2_;
    Eigen::ArrayXcd weight_, moment_;
};

} // namespace

Eigen::VectorXd low_passed(const Profile& profile, double cut_off) {
    if (!(cut_off > 0))
        refuse("filter: the cut-off ", cut_off, " mm is out of range (above 0)");
    const auto [columns, rows] = profile.shape();
    Eigen::MatrixXd z = profile.heights.reshaped(columns, rows);
    const LineFilter along_x(columns, profile.spacing, cut_off);
    for (Index j = 0; j < rows; ++j)
        z.col(j) = along_x(z.col(j));
    if (profile.is_2d()) {
        const LineFilter along_y(rows, profile.row_spacing, cut_off);
        for (Index i = 0; i < columns; ++i)
            z.row(i) = along_y(z.row(i).transpose()).transpose();
    }
    return z.reshaped();
}

} // namespace rough
