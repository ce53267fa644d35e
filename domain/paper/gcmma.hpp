#pragma once

#include "ga/refinement/mma.hpp"

namespace rough {

/// Maximises s|s| with s = 1 - max_k |r_k| by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA): the form of the paper, s^2, without its reward for worse fits once s < 0. The
/// maximum norm has corners; the gradient there is that of the first row that attains it.
struct Gcmma {
    static constexpr bool on_residuals = true; ///< and on their derivatives

    int evaluations = 1; ///< at most, after the start; >= 1. Inner iterations count.

    ///@{
    /// What every method has (ga::method_of).
    static ga::Words words() { return {"gcmma", "refinement", "GCMMA on s|s|, s = 1 - max|r|: the paper's"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, ga::evaluations_parameter()); }
    Eigen::VectorXd improve(const ga::Landscape& land) const {
        return ga::maximised_by_mma(land, evaluations, [](const Eigen::VectorXd& residuals) -> ga::Reading {
            Eigen::Index worst = 0;
            const double s = 1 - residuals.cwiseAbs().maxCoeff(&worst);
            const double sign = residuals[worst] < 0 ? -1 : 1;
            return {s * std::abs(s), s, {{worst, -2 * std::abs(s) * sign}}};
        });
    }
    ///@}
};

/// @param evaluations  at most, after the start; >= 1
inline ga::ResidualMethod gcmma(int evaluations) { return ga::method_of(Gcmma{evaluations}); }

} // namespace rough
