#pragma once

#include "ga/refinement/nlopt.hpp"

namespace ga {

/// Throws UsageError, naming the method, on less than 1.
inline void check_evaluations(const std::string& method, int evaluations) {
    if (evaluations < 1)
        throw UsageError("refine " + method + ": evaluations are " + std::to_string(evaluations) +
                         "; expected 1 at least");
}

/// A method's number of evaluations after the start, kept so that `minimax` can wrap it.
struct Gcmma : ResidualMethod {
    int evaluations = 0; ///< after the start, >= 1
};

/// Maximises s|s| with s = 1 - max_k |r_k| by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA): the form of the paper, s^2, without its reward for worse fits once s < 0. The
/// maximum norm has corners; the gradient there is that of the first row that attains it.
/// @param evaluations  at most, after the start; >= 1. Inner iterations count.
inline Gcmma gcmma(int evaluations) {
    check_evaluations("gcmma", evaluations);
    Gcmma method;
    method.evaluations = evaluations;
    method.text = "gcmma " + std::to_string(evaluations);
    method.improve = [=](const Landscape& land) {
        NloptSearch search(nlopt::LD_MMA, land.lower, land.upper, evaluations + 1);
        BestPoint best{land.start, -HUGE_VAL};
        search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
            Eigen::Map<Eigen::VectorXd> slope(gradient, gradient ? x.size() : 0);
            slope.setZero();
            if (land.exhausted()) {
                search->force_stop();
                return HUGE_VAL;
            }
            const std::optional<Sensitivity> at = land.sensitivity(x);
            if (!at)
                return HUGE_VAL;
            Eigen::Index worst = 0;
            const double s = 1 - at->residuals.cwiseAbs().maxCoeff(&worst);
            const double sign = at->residuals[worst] < 0 ? -1 : 1;
            if (gradient)
                slope = 2 * std::abs(s) * sign * at->jacobian.row(worst).transpose();
            best.offer(x, s);
            return -s * std::abs(s);
        });
        search.from(land.start);
        return best.x;
    };
    return method;
}

/// The same search on the same maximum norm in its smooth form: minimise t subject to r_k - t <= 0 and -r_k -
/// t <= 0, with t as one more variable. Where s|s| sees one row at a time, this sees all.
inline ResidualMethod minimax(const Gcmma& gcmma) {
    ResidualMethod method;
    method.text = "minimax " + std::to_string(gcmma.evaluations);
    method.improve = [evaluations = gcmma.evaluations](const Landscape& land) -> Eigen::VectorXd {
        const Eigen::Index n = land.start.size();
        const std::optional<Sensitivity> first =
            land.exhausted() ? std::nullopt : land.sensitivity(land.start);
        if (!first)
            return land.start;
        const Eigen::Index rows = first->residuals.size();
        const double worst = first->residuals.cwiseAbs().maxCoeff();
        if (worst == 0)
            return land.start;
        // The first step is about half of the box, so t's is no wider than it must be.
        Eigen::VectorXd lower(n + 1), upper(n + 1), start(n + 1);
        lower << land.lower, 0.0;
        upper << land.upper, worst;
        start << land.start, worst;
        NloptSearch search(nlopt::LD_MMA, lower, upper, evaluations + 1);
        // LD_MMA solves each step's dual to 1e-14 by itself: 160 times the time for the same answers.
        search->set_param("dual_ftol_rel", 1e-6);
        BestPoint best{land.start, -worst};
        bool at_start = true; // its sensitivity is known
        search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
            if (gradient)
                Eigen::Map<Eigen::VectorXd>(gradient, n + 1) = Eigen::VectorXd::Unit(n + 1, n);
            return x[n];
        });
        search.constrain(
            static_cast<unsigned>(2 * rows), [&](const Eigen::VectorXd& x, double* c, double* gradient) {
                using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
                Eigen::Map<Eigen::VectorXd> values(c, 2 * rows);
                Eigen::Map<Rows> slopes(gradient, gradient ? 2 * rows : 0, gradient ? n + 1 : 0);
                values.setConstant(HUGE_VAL);
                slopes.setZero();
                if (!at_start && land.exhausted()) {
                    search->force_stop();
                    return;
                }
                const std::optional<Sensitivity> at = at_start ? first : land.sensitivity(x.head(n));
                at_start = false;
                if (!at)
                    return;
                values << at->residuals.array() - x[n], -at->residuals.array() - x[n];
                if (gradient) {
                    slopes.topLeftCorner(rows, n) = at->jacobian;
                    slopes.bottomLeftCorner(rows, n) = -at->jacobian;
                    slopes.col(n).setConstant(-1);
                }
                best.offer(x.head(n), -at->residuals.cwiseAbs().maxCoeff());
            });
        search.from(start);
        return best.x;
    };
    return method;
}

} // namespace ga
