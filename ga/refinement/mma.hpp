#pragma once

#include "ga/refinement/nlopt.hpp"

namespace ga {

/// One number of residuals that a search maximises, and its derivatives with respect to them.
struct Reading {
    double value; ///< greater is better
    double merit; ///< by which the best point is chosen, greater is better
    std::vector<std::pair<Eigen::Index, double>> slopes; ///< d value / d r_k for the rows k where it is not 0
};

/// Minus the largest |r_k|; its slope is that of the first row that attains it.
inline Reading least_worst(const Eigen::VectorXd& residuals) {
    Eigen::Index worst = 0;
    const double largest = residuals.cwiseAbs().maxCoeff(&worst);
    return {-largest, -largest, {{worst, residuals[worst] < 0 ? 1.0 : -1.0}}};
}

/// Maximises a reading of the residuals by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA). The reading is the problem's own; by default `least_worst`.
/// @param evaluations  at most, after the start; inner iterations count
inline Eigen::VectorXd maximised_by_mma(const Landscape& land, int evaluations,
                                        const std::function<Reading(const Eigen::VectorXd&)>& read) {
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
        const Reading reading = read(at->residuals);
        if (gradient)
            for (const auto& [row, rate] : reading.slopes)
                slope -= rate * at->jacobian.row(row).transpose();
        best.offer(x, reading.merit);
        return -reading.value;
    });
    search.from(land.start);
    return best.x;
}

/// `mma n`: the method above on `least_worst`. A domain with another reading makes a method of its own so.
struct Mma {
    static constexpr bool on_residuals = true; ///< and on their derivatives

    int evaluations = 1; ///< at most, after the start; >= 1

    ///@{
    /// What every method has (method_of).
    static Words words() { return {"mma", "refinement", "GCMMA on the largest |r|, one row at a time"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }
    Eigen::VectorXd improve(const Landscape& land) const {
        return maximised_by_mma(land, evaluations, least_worst);
    }
    ///@}
};

/// @param evaluations  at most, after the start; >= 1
inline ResidualMethod mma(int evaluations) { return method_of(Mma{evaluations}); }

} // namespace ga
