#pragma once

#include "ga/refinement/landscape.hpp"

namespace ga {

/// Minimises the sum of squared residuals in the box by Levenberg-Marquardt with Marquardt's scaling (1963)
/// and Nielsen's damping (1999). A variable at a bound stays there if the descent points beyond the bound.
/// Steps are cut at the box.
struct LevenbergMarquardt {
    static constexpr bool on_residuals = true; ///< whether it uses residuals and their derivatives

    int evaluations = 30; ///< maximum number of evaluations after the start point, >= 1
    /// Number of evaluations after which steps minimise the largest residual of the linear model instead of the sum of
    /// squares; 0: never. Lawson's iteration (1961) weights the rows. A step is then accepted if it reduces max|r|.
    int sharpen = 0;

    static Words words() { return {"lm", "refinement", "Levenberg-Marquardt on the residuals' squares"}; }
    static void describe(auto& self, auto visit) {
        visit(self.evaluations, evaluations_parameter().optional());
        visit(self.sharpen,
              whole("sharpen", 0, "after this many, the largest residual counts; 0 for never").keyed().quiet());
    }

    /// The best point found (Method).
    Eigen::VectorXd improve(const Landscape& land) const;
};

/// The method `lm evaluations sharpen=sharpen`.
inline ResidualMethod lm(int evaluations = 30, int sharpen = 0) {
    return method_of(LevenbergMarquardt{evaluations, sharpen});
}

} // namespace ga
