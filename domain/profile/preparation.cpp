#include "domain/profile/preparation.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/connected.hpp"
#include "domain/numerics/fourier.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/QR>

#include <cmath>
#include <numeric>

namespace rough {
namespace {

/// The height w over c of the circle through (0, c) with angle theta and curvature kappa there. It solves
/// kappa (x^2 + w^2)/2 + x sin(theta) - w cos(theta) = 0, a line for kappa = 0.
double arc_height(double x, double theta, double kappa) {
    const double part = kappa * x * x / 2 + x * std::sin(theta), cosine = std::cos(theta);
    return 2 * part / (cosine + std::sqrt(cosine * cosine - 2 * kappa * part));
}

/// Heights minus their arc, by Gauss-Newton in c, theta and kappa from 0.
Eigen::VectorXd without_arc(const Profile& profile) {
    const Index nodes = profile.nodes();
    const double half = profile.spacing * static_cast<double>(nodes - 1) / 2;
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(nodes, -half, half);
    Eigen::Vector3d of = Eigen::Vector3d::Zero(); // c, theta, kappa
    Eigen::MatrixXd slopes(nodes, 3);
    Eigen::VectorXd rest = profile.heights;
    constexpr int max_steps = 50;
    for (int step = 0; step < max_steps; ++step) {
        for (Index i = 0; i < nodes; ++i) {
            const double w = arc_height(x[i], of[1], of[2]);
            const double by_w = of[2] * w - std::cos(of[1]);
            rest[i] = profile.heights[i] - of[0] - w;
            slopes.row(i) << 1, -(w * std::sin(of[1]) + x[i] * std::cos(of[1])) / by_w,
                -(x[i] * x[i] + w * w) / 2 / by_w;
        }
        if (!rest.allFinite()) refuse("detrend: no arc of a circle fits the heights; use parabola or another form");
        const Eigen::Vector3d scale(1, half, half * half);
        const Eigen::Vector3d change = (slopes * scale.cwiseInverse().asDiagonal()).colPivHouseholderQr().solve(rest);
        of += change.cwiseQuotient(scale);
        if (change.cwiseAbs().maxCoeff() <= 1e-14 * (of.cwiseProduct(scale)).cwiseAbs().maxCoeff()) break;
    }
    return rest;
}

/// Polynomials of degree 0 to `degree` over even nodes in [-1, 1], orthogonal there (Gram-Schmidt).
std::vector<Eigen::VectorXd> orthogonal_polynomials(Index nodes, Index degree) {
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(nodes, -1, 1);
    std::vector<Eigen::VectorXd> basis{Eigen::VectorXd::Ones(nodes)};
    for (Index power = 1; power <= degree && power < nodes; ++power) {
        Eigen::VectorXd next = basis.back().array() * t;
        for (const Eigen::VectorXd& one : basis) next -= one * (one.dot(next) / one.squaredNorm());
        if (!(next.squaredNorm() > 0)) break;
        basis.push_back(std::move(next));
    }
    return basis;
}

} // namespace

const std::vector<std::string>& detrend_names() {
    static const std::vector<std::string> names{"none", "mean", "line", "parabola", "cubic", "quartic", "arc"};
    return names;
}

const std::string& name_of(Detrend form) { return detrend_names()[static_cast<std::size_t>(form)]; }

Eigen::VectorXd detrended(const Profile& profile, Detrend form) {
    if (form == Detrend::none) return profile.heights;
    if (form == Detrend::arc && profile.is_2d())
        refuse("detrend: an arc does not fit a map; use none, mean, line, parabola, cubic or quartic");
    if (form == Detrend::arc) return without_arc(profile);
    // Products of polynomials along x and y are orthogonal on a grid.
    const auto [columns, rows] = profile.shape();
    const Index degree = static_cast<Index>(form) - 1;
    const auto along_x = orthogonal_polynomials(columns, degree),
               along_y = orthogonal_polynomials(rows, profile.is_2d() ? degree : 0);
    Eigen::MatrixXd rest =
        Eigen::Map<const Eigen::MatrixXd>(profile.heights.data(), columns, rows).array() - profile.heights.mean();
    for (std::size_t a = 0; a < along_x.size(); ++a)
        for (std::size_t b = 0; b < along_y.size() && a + b <= static_cast<std::size_t>(degree); ++b)
            if (a + b > 0) {
                const Eigen::VectorXd &p = along_x[a], &q = along_y[b];
                const double share = p.dot(rest * q) / (p.squaredNorm() * q.squaredNorm());
                rest.noalias() -= p * (share * q).transpose();
            }
    return rest.reshaped();
}

namespace {

/// A sequence's transform, padded with zeros.
Eigen::ArrayXcd transformed(const Eigen::VectorXd& values, Index length) {
    Eigen::ArrayXd padded = Eigen::ArrayXd::Zero(length);
    padded.head(values.size()) = values.array();
    return fourier_transform(padded);
}

/// The filter for lines of one length.
class LineFilter {
  public:
    LineFilter(Index nodes, double spacing, double cut_off) : nodes_(nodes) {
        reach_ = static_cast<Index>(std::min(std::floor(cut_off / spacing), static_cast<double>(nodes - 1)));
        if (reach_ == 0) return;
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
        if (reach_ == 0) return line;
        const double mean = line.mean();
        const Eigen::ArrayXcd heights = transformed(line.array() - mean, length_);
        // sum_t weight_t z_(i+t) for each node i, t = -reach .. reach
        const auto correlated = [&](const Eigen::ArrayXcd& weights) -> Eigen::ArrayXd {
            return inverse_fourier_transform(heights * weights, length_).col(0).segment(reach_, nodes_) /
                   static_cast<double>(length_);
        };
        const Eigen::ArrayXd t0 = correlated(weight_), t1 = correlated(moment_);
        Eigen::VectorXd result(nodes_);
        for (Index i = 0; i < nodes_; ++i) {
            const Index first = std::max<Index>(reach_ - i, 0), past = std::min(reach_ + nodes_ - i, 2 * reach_ + 1);
            const double m0 = s0_[past] - s0_[first], m1 = s1_[past] - s1_[first], m2 = s2_[past] - s2_[first];
            result[i] = mean + (t0[i] * m2 - t1[i] * m1) / (m0 * m2 - m1 * m1);
        }
        return result;
    }

  private:
    Index nodes_, reach_, length_ = 0;
    Eigen::ArrayXd s0_, s1_, s2_;
    Eigen::ArrayXcd weight_, moment_; ///< transforms of the reversed weights and of their moments
};

} // namespace

Eigen::VectorXd low_passed(const Profile& profile, double cut_off) {
    if (!(cut_off > 0)) refuse("filter: the cut-off ", cut_off, " mm is out of range (above 0)");
    const auto [columns, rows] = profile.shape();
    Eigen::MatrixXd z = profile.heights.reshaped(columns, rows);
    const LineFilter along_x(columns, profile.spacing, cut_off);
    for (Index j = 0; j < rows; ++j) z.col(j) = along_x(z.col(j));
    if (profile.is_2d()) {
        const LineFilter along_y(rows, profile.row_spacing, cut_off);
        for (Index i = 0; i < columns; ++i) z.row(i) = along_y(z.row(i).transpose()).transpose();
    }
    return z.reshaped();
}

Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes) {
    for (std::size_t at = 0; at < nodes.size();) {
        std::size_t end = at + 1; // after a run of nodes
        while (end < nodes.size() && nodes[end] == nodes[end - 1] + 1) ++end;
        const Index left = nodes[at] - 1, right = nodes[end - 1] + 1;
        if (left < 0 && right == heights.size()) break;
        const double from = heights[left < 0 ? right : left], to = heights[right == heights.size() ? left : right];
        for (; at < end; ++at)
            heights[nodes[at]] =
                from + (to - from) * static_cast<double>(nodes[at] - left) / static_cast<double>(right - left);
    }
    return heights;
}

MissingPoints missing_points(const Profile& surface) {
    MissingPoints missing;
    for (Index i = 0; i < surface.nodes(); ++i)
        if (std::isnan(surface.heights[i])) missing.nodes.push_back(i);
    if (missing.nodes.empty()) return missing;
    missing.share = static_cast<double>(missing.nodes.size()) / static_cast<double>(surface.nodes());
    const Index largest = group_sizes(missing.nodes, surface.shape(), false).front();
    missing.largest_hole = static_cast<double>(largest) * surface.spacing * (surface.is_2d() ? surface.row_spacing : 1);
    return missing;
}

namespace {

/// Continues a map's heights into its holes by Laplace's equation.
void continue_into(Eigen::VectorXd& heights, const MissingPoints& missing, const Profile& map) {
    const auto count = static_cast<Index>(missing.nodes.size());
    std::vector<Index> unknown(static_cast<std::size_t>(map.nodes()), -1);
    for (Index k = 0; k < count; ++k) unknown[static_cast<std::size_t>(missing.nodes[static_cast<std::size_t>(k)])] = k;
    const double across = std::pow(map.spacing / map.row_spacing, 2); // weight; along x it is 1
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd known = Eigen::VectorXd::Zero(count);
    for (Index k = 0; k < count; ++k) {
        const Index node = missing.nodes[static_cast<std::size_t>(k)];
        double sum = 0;
        each_neighbour(node, map.shape(), false, [&](Index other) {
            const double weight = std::abs(other - node) == 1 ? 1 : across;
            sum += weight;
            if (const Index at = unknown[static_cast<std::size_t>(other)]; at >= 0)
                entries.emplace_back(k, at, -weight);
            else
                known[k] += weight * heights[other];
        });
        entries.emplace_back(k, k, sum);
    }
    Eigen::SparseMatrix<double> laplacian(count, count);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(laplacian);
    solver.setTolerance(1e-13);
    const Eigen::VectorXd found = solver.solve(known);
    heights(missing.nodes) = found;
}

} // namespace

void expect_fillable(const MissingPoints& missing, double max_share, bool is_2d, const std::string& where) {
    if (missing.share > max_share || missing.share == 1)
        throw InputError(line_of(where, ": ", in_words(missing, is_2d), ", more than the share ", max_share,
                                 " that may be filled; measure again, or cut the holes off"),
                         "max-filled");
}

Profile filled(Profile surface, const MissingPoints& missing, double max_share) {
    if (!missing) return surface;
    expect_fillable(missing, max_share, surface.is_2d());
    if (!surface.is_2d()) {
        surface.heights = interpolated(std::move(surface.heights), missing.nodes);
        return surface;
    }
    const auto [columns, rows] = surface.shape();
    const auto powers = [wide = columns, high = rows](Index node) {
        return Eigen::Vector3d(1, static_cast<double>(2 * (node % wide)) / static_cast<double>(wide) - 1,
                               static_cast<double>(2 * (node / wide)) / static_cast<double>(high) - 1);
    };
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (Index i = 0; i < surface.nodes(); ++i)
        if (const Eigen::Vector3d of = powers(i); !std::isnan(surface.heights[i])) {
            moments += of * of.transpose();
            sums += surface.heights[i] * of;
        }
    const Eigen::Vector3d plane = moments.completeOrthogonalDecomposition().solve(sums);
    Eigen::VectorXd rest(surface.nodes());
    for (Index i = 0; i < surface.nodes(); ++i) rest[i] = surface.heights[i] - plane.dot(powers(i));
    continue_into(rest, missing, surface);
    for (const Index node : missing.nodes) surface.heights[node] = rest[node] + plane.dot(powers(node));
    return surface;
}

Profile without(Profile surface, const std::vector<Index>& nodes) {
    surface.heights(nodes).setConstant(std::numeric_limits<double>::quiet_NaN());
    const MissingPoints missing = missing_points(surface);
    return filled(std::move(surface), missing);
}

std::string in_words(const MissingPoints& missing, bool is_2d) {
    const std::size_t count = missing.nodes.size();
    return line_with_digits(3, count, " missing point", count == 1 ? "" : "s", " (", 100 * missing.share,
                            " %), largest hole ", missing.largest_hole, is_2d ? " mm²" : " mm");
}

} // namespace rough
