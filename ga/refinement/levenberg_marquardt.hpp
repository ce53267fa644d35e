#pragma once

#include "ga/refinement/landscape.hpp"

#include <Eigen/Cholesky>

namespace ga {

/// Minimises the sum of squared residuals in the box by Levenberg-Marquardt with Marquardt's scaling (1963)
/// and Nielsen's damping (1999). Variables at a bound towards which the descent points stay there; a step is
/// cut at the box.
struct LevenbergMarquardt {
    static constexpr bool on_residuals = true; ///< and on their derivatives

    int evaluations = 30; ///< at most, after the start; >= 1
    /// After this many of them, row k weighs (|r_k| / max|r|)^2 + 0.05, which drives the squares towards the
    /// maximum norm; 0 for never.
    int sharpen = 0;

    ///@{
    /// What every method has (method_of).
    static Words words() { return {"lm", "refinement", "Levenberg-Marquardt on the residuals' squares"}; }
    static void describe(auto& self, auto visit) {
        visit(self.evaluations, evaluations_parameter("30"));
        visit(self.sharpen, whole("sharpen", "0", 0, "after so many, great residuals weigh more; 0 for never")
                                .keyed()
                                .quiet());
    }

    Eigen::VectorXd improve(const Landscape& land) const {
        using Eigen::VectorXd;
        std::optional<Sensitivity> at = land.exhausted() ? std::nullopt : land.sensitivity(land.start);
        if (!at)
            return land.start;
        const auto merit = [&](const Sensitivity& there) {
            return sharpen > 0 ? -there.residuals.cwiseAbs().maxCoeff() : -there.residuals.squaredNorm();
        };
        BestPoint best{land.start, merit(*at)};
        VectorXd x = land.start;
        double damping = 1e-3, growth = 2;
        for (int used = 0; used < evaluations && !land.exhausted(); ++used) {
            VectorXd weights = VectorXd::Ones(at->residuals.size());
            if (sharpen > 0 && used >= sharpen) {
                const double worst = at->residuals.cwiseAbs().maxCoeff();
                if (worst > 0)
                    weights = (at->residuals / worst).array().square() + 0.05;
            }
            const auto cost = [&](const VectorXd& r) { return (weights.array() * r.array().square()).sum(); };
            VectorXd slope = at->jacobian.transpose() * weights.cwiseProduct(at->residuals);
            Eigen::MatrixXd curvature = at->jacobian.transpose() * weights.asDiagonal() * at->jacobian;
            const double largest = curvature.diagonal().maxCoeff();
            for (Eigen::Index i = 0; i < x.size(); ++i)
                if ((x[i] <= land.lower[i] && slope[i] > 0) || (x[i] >= land.upper[i] && slope[i] < 0)) {
                    curvature.row(i).setZero();
                    curvature.col(i).setZero();
                    slope[i] = 0;
                }
            if (largest <= 0 || slope.cwiseAbs().maxCoeff() == 0)
                break;
            const VectorXd scale = curvature.diagonal().cwiseMax(1e-12 * largest);
            Eigen::MatrixXd damped = curvature;
            damped.diagonal() += damping * scale;
            const VectorXd there = (x - damped.ldlt().solve(slope)).cwiseMax(land.lower).cwiseMin(land.upper);
            const VectorXd step = there - x;
            if (!step.allFinite() || step.cwiseAbs().maxCoeff() == 0)
                break;
            std::optional<Sensitivity> next = land.sensitivity(there);
            const double before = cost(at->residuals), after = next ? cost(next->residuals) : HUGE_VAL;
            if (after < before) {
                const double predicted = -2 * slope.dot(step) - step.dot(curvature * step);
                const double gain = predicted > 0 ? (before - after) / predicted : 1;
                damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
                growth = 2;
                x = there;
                at = std::move(next);
                best.offer(x, merit(*at));
                if (before - after < 1e-14 * before)
                    break;
            } else {
                damping *= growth;
                growth *= 2;
            }
        }
        return best.x;
    }
    ///@}
};

/// @param evaluations  at most, after the start; >= 1
/// @param sharpen      see LevenbergMarquardt
inline ResidualMethod lm(int evaluations = 30, int sharpen = 0) {
    return method_of(LevenbergMarquardt{evaluations, sharpen});
}

} // namespace ga
