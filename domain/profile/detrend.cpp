#include "domain/profile/detrend.hpp"

#include "domain/errors.hpp"

#include <Eigen/QR>

#include <cmath>

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
        if (!rest.allFinite())
            refuse("detrend: no arc of a circle fits the heights; use parabola or another form");
        const Eigen::Vector3d scale(1, half, half * half);
        const Eigen::Vector3d change =
            (slopes * scale.cwiseInverse().asDiagonal()).colPivHouseholderQr().solve(rest);
        of += change.cwiseQuotient(scale);
        if (change.cwiseAbs().maxCoeff() <= 1e-14 * (of.cwiseProduct(scale)).cwiseAbs().maxCoeff())
            break;
    }
    return rest;
}

/// Polynomials of degree 0 to `degree` over even nodes in [-1, 1], orthogonal there (Gram-Schmidt).
std::vector<Eigen::VectorXd> orthogonal_polynomials(Index nodes, Index degree) {
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(nodes, -1, 1);
    std::vector<Eigen::VectorXd> basis{Eigen::VectorXd::Ones(nodes)};
    for (Index power = 1; power <= degree && power < nodes; ++power) {
        Eigen::VectorXd next = basis.back().array() * t;
        for (const Eigen::VectorXd& one : basis)
            next -= one * (one.dot(next) / one.squaredNorm());
        if (!(next.squaredNorm() > 0))
            break;
        basis.push_back(std::move(next));
    }
    return basis;
}

} // namespace

const std::vector<std::string>& detrend_names() {
    static const std::vector<std::string> names{"none",  "mean",    "line", "parabola",
                                                "cubic", "quartic", "arc"};
    return names;
}

const std::string& name_of(Detrend form) { return detrend_names()[static_cast<std::size_t>(form)]; }

Detrend detrend_named(std::string_view name, const std::string& where) {
    const auto& names = detrend_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        refuse(where, ": '", name, "' is unknown; use none, mean, line, parabola, cubic, quartic or arc");
    return static_cast<Detrend>(found - names.begin());
}

Eigen::VectorXd detrended(const Profile& profile, Detrend form) {
    if (form == Detrend::none)
        return profile.heights;
    if (form == Detrend::arc && profile.is_2d())
        refuse("detrend: an arc does not fit a map; use none, mean, line, parabola, cubic or quartic");
    if (form == Detrend::arc)
        return without_arc(profile);
    // Products of polynomials along x and y are orthogonal on a grid.
    const auto [columns, rows] = profile.shape();
    const Index degree = static_cast<Index>(form) - 1;
    const auto along_x = orthogonal_polynomials(columns, degree),
               along_y = orthogonal_polynomials(rows, profile.is_2d() ? degree : 0);
    Eigen::MatrixXd rest = Eigen::Map<const Eigen::MatrixXd>(profile.heights.data(), columns, rows).array() -
                           profile.heights.mean();
    for (std::size_t a = 0; a < along_x.size(); ++a)
        for (std::size_t b = 0; b < along_y.size() && a + b <= static_cast<std::size_t>(degree); ++b)
            if (a + b > 0) {
                const Eigen::VectorXd &p = along_x[a], &q = along_y[b];
                const double share = p.dot(rest * q) / (p.squaredNorm() * q.squaredNorm());
                for (Index j = 0; j < rows; ++j)
                    rest.col(j) -= p * (share * q[j]);
            }
    return rest.reshaped();
}

} // namespace rough
