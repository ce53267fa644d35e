#pragma once

#include "ga/refinement/nlopt.hpp"

namespace ga {

/// A function of the residuals that a search maximises, with its derivatives.
struct ResidualMerit {
    double value;                                        ///< higher is better
    double merit;                                        ///< ranks points, higher is better
    std::vector<std::pair<Eigen::Index, double>> slopes; ///< rows k and d value / d r_k, if it is not 0
};

/// Minus the largest |r_k| of the residuals r. The slope is taken from the first row k with this value.
inline ResidualMerit minus_largest(const Eigen::VectorXd& residuals) {
    Eigen::Index worst = 0;
    const double largest = residuals.cwiseAbs().maxCoeff(&worst);
    return {-largest, -largest, {{worst, residuals[worst] < 0 ? 1.0 : -1.0}}};
}

/// Maximises a function of the residuals by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA). `read` returns the function's value and derivatives for given residuals.
/// @param evaluations  maximum number of evaluations after the start point; inner iterations count
inline Eigen::VectorXd maximised_by_mma(const auto& land, int evaluations,
                                        const std::function<ResidualMerit(const Eigen::VectorXd&)>& read) {
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
        const ResidualMerit reading = read(at->residuals);
        if (gradient)
            for (const auto& [row, rate] : reading.slopes)
                slope -= rate * at->jacobian.row(row).transpose();
        best.offer(x, reading.merit);
        return -reading.value;
    });
    search.from(land.start);
    return best.x;
}

/// The method `mma n`: maximised_by_mma() with minus_largest(). A domain can make a method with another
/// function of the residuals.
struct Mma {
    static constexpr bool on_residuals = true; ///< whether it uses residuals and their derivatives

    int evaluations = 1; ///< maximum number of evaluations after the start point, >= 1

    static Words words() { return {"mma", "refinement", "GCMMA on the largest |r|, one row at a time"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }
    Eigen::VectorXd improve(const auto& land) const {
        return maximised_by_mma(land, evaluations, minus_largest);
    }
};

/// The method `mma evaluations`.
inline ResidualMethod mma(std::integral auto evaluations) { return method_of(Mma{evaluations}); }

/// Minimises the largest |r_k| by the globally convergent method of moving asymptotes (Svanberg 2002; NLopt's
/// LD_MMA). The problem is smooth: minimise t subject to r_k - t <= 0 and -r_k - t <= 0, with t as one more
/// variable. `mma` uses one row at a time, and this method all rows.
struct Minimax {
    static constexpr bool on_residuals = true; ///< whether it uses residuals and their derivatives

    int evaluations = 1; ///< maximum number of evaluations after the start point, >= 1; inner ones count

    static Words words() { return {"minimax", "refinement", "GCMMA on the smallest t with -t <= r <= t"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }

    Eigen::VectorXd improve(const auto& land) const {
        const Eigen::Index n = land.start.size();
        const std::optional<Sensitivity> first =
            land.exhausted() ? std::nullopt : land.sensitivity(land.start);
        if (!first)
            return land.start;
        const Eigen::Index rows = first->residuals.size();
        const double worst = first->residuals.cwiseAbs().maxCoeff();
        if (worst == 0)
            return land.start;
        // The first step is about half of the box, so the box of t is as narrow as possible.
        Eigen::VectorXd lower(n + 1), upper(n + 1), start(n + 1);
        lower << land.lower, 0.0;
        upper << land.upper, worst;
        start << land.start, worst;
        NloptSearch search(nlopt::LD_MMA, lower, upper, evaluations + 1);
        // By default LD_MMA solves each step's dual to 1e-14, which takes 160 times as long for the same
        // result.
        search->set_param("dual_ftol_rel", 1e-6);
        BestPoint best{land.start, -worst};
        bool at_start = true; // the sensitivity there is known
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
    }
};

/// The method `minimax evaluations`.
inline ResidualMethod minimax(std::integral auto evaluations) { return method_of(Minimax{evaluations}); }

} // namespace ga
