#include "ga/refinement/levenberg_marquardt.hpp"

#include <Eigen/Cholesky>

namespace ga {
namespace {

constexpr int lawson_rounds = 20;
constexpr double min_weight = 1e-6;
constexpr Eigen::Index many_variables = 128;

/// A point in the box and the residuals there by the linear model.
struct Step {
    Eigen::VectorXd to, left;
};
/// The damped step of weighted least squares; none if it does not move.
std::optional<Step> step_from(const Eigen::VectorXd& x, const Sensitivity& at, const Eigen::VectorXd& weights,
                              double damping, const Landscape& land) {
    const Eigen::Index count = x.size(), rows = at.residuals.size();
    const bool by_rows = count > many_variables && count > 4 * rows; // a smaller system than by variables
    Eigen::MatrixXd jacobian = at.jacobian;
    Eigen::VectorXd slope = jacobian.transpose() * weights.cwiseProduct(at.residuals);
    Eigen::MatrixXd curvature;
    if (!by_rows) curvature = jacobian.transpose() * weights.asDiagonal() * jacobian;
    Eigen::VectorXd diagonal =
        by_rows ? Eigen::VectorXd(jacobian.cwiseAbs2().transpose() * weights) : curvature.diagonal();
    const double largest = diagonal.maxCoeff();
    for (Eigen::Index i = 0; i < count; ++i)
        if ((x[i] <= land.lower[i] && slope[i] > 0) || (x[i] >= land.upper[i] && slope[i] < 0)) {
            jacobian.col(i).setZero();
            if (!by_rows) curvature.row(i).setZero(), curvature.col(i).setZero();
            slope[i] = diagonal[i] = 0;
        }
    if (largest <= 0 || slope.cwiseAbs().maxCoeff() == 0) return std::nullopt;
    const Eigen::VectorXd damped = damping * diagonal.cwiseMax(1e-12 * largest);
    Eigen::VectorXd change;
    if (by_rows) { // (J^T W J + D)^-1 J^T W r = D^-1 J^T (W^-1 + J D^-1 J^T)^-1 r (Woodbury)
        const Eigen::MatrixXd scaled = jacobian * damped.cwiseInverse().asDiagonal();
        Eigen::MatrixXd system = scaled * jacobian.transpose();
        system.diagonal() += weights.cwiseInverse();
        change = scaled.transpose() * system.ldlt().solve(at.residuals);
    } else {
        curvature.diagonal() += damped;
        change = curvature.ldlt().solve(slope);
    }
    const Eigen::VectorXd to = (x - change).cwiseMax(land.lower).cwiseMin(land.upper);
    if (!to.allFinite() || to == x) return std::nullopt;
    return Step{to, at.residuals + at.jacobian * (to - x)};
}

} // namespace

Eigen::VectorXd LevenbergMarquardt::improve(const Landscape& land) const {
    std::optional<Sensitivity> at = land.exhausted() ? std::nullopt : land.sensitivity(land.start);
    if (!at) return land.start;
    const auto largest = [](const Eigen::VectorXd& r) { return r.cwiseAbs().maxCoeff(); };
    const auto merit = [&](const Sensitivity& there) {
        return sharpen > 0 ? -largest(there.residuals) : -there.residuals.squaredNorm();
    };
    BestPoint best{land.start, merit(*at)};
    Eigen::VectorXd x = land.start;
    double damping = 1e-3, growth = 2;
    for (int used = 0; used < evaluations && !land.exhausted(); ++used) {
        const bool sharpened = sharpen > 0 && used >= sharpen;
        const auto cost = [&](const Eigen::VectorXd& r) { return sharpened ? largest(r) : r.squaredNorm(); };
        Eigen::VectorXd weights = Eigen::VectorXd::Ones(at->residuals.size());
        std::optional<Step> step = step_from(x, *at, weights, damping, land), last = step;
        for (int round = 1; sharpened && last && largest(last->left) > 0 && round < lawson_rounds; ++round) {
            weights = weights.cwiseProduct(last->left.cwiseAbs());
            weights = (weights / weights.maxCoeff()).cwiseMax(min_weight);
            last = step_from(x, *at, weights, damping, land);
            if (last && largest(last->left) < largest(step->left)) step = last;
        }
        if (!step) break;
        std::optional<Sensitivity> next = land.sensitivity(step->to);
        const double before = cost(at->residuals), after = next ? cost(next->residuals) : HUGE_VAL;
        if (after < before) {
            const double predicted = before - cost(step->left);
            const double gain = predicted > 0 ? (before - after) / predicted : 1;
            damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
            growth = 2;
            x = step->to;
            at = std::move(next);
            best.offer(x, merit(*at));
            if (before - after < 1e-14 * before) break;
        } else {
            damping *= growth;
            growth *= 2;
        }
    }
    return best.x;
}

} // namespace ga
