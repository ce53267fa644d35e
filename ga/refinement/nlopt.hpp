#pragma once

#include "ga/refinement/landscape.hpp"

namespace ga {

/// NLopt's number of the algorithm with that name. Throws UsageError on another name, and on algorithms that
/// need a second optimiser.
int algorithm_number(const std::string& name);

/// Any local or global algorithm of NLopt that works in a box without a second optimiser. It maximises the
/// fitness. Algorithms that work with inequality constraints without gradients (`takes_constraints`) get the
/// problem's constraints.
struct Nlopt {
    static constexpr bool on_residuals = false; ///< whether it uses residuals; it uses the fitness

    std::string algorithm = "LN_COBYLA"; ///< NLopt's name; LD_ and GD_ algorithms need a gradient
    int evaluations = 1;                 ///< maximum number of evaluations after the start point, >= 1

    static Words words() { return {"nlopt", "refinement", "any algorithm of NLopt on the fitness"}; }
    static void describe(auto& self, auto visit) {
        visit(self.algorithm, word("algorithm", std::nullopt, "NLopt's name, e.g. LN_COBYLA"));
        visit(self.evaluations, evaluations_parameter());
    }
    void validate() const;
    bool needs_gradient() const { return algorithm[1] == 'D'; }
    /// Whether the algorithm gets the problem's constraints. For other algorithms a point that violates a
    /// constraint has no fitness. Algorithms with gradients would need gradients of the constraints.
    bool takes_constraints() const {
        return algorithm == "LN_COBYLA" || algorithm == "GN_ISRES" || algorithm.starts_with("GN_ORIG_DIRECT");
    }

    /// The best point found (Method).
    Eigen::VectorXd improve(const Landscape& land) const;
};

/// The refinement `nlopt NAME n`. Throws UsageError if the name is unknown or needs a second optimiser.
Method nlopt_method(const std::string& name, int evaluations);

} // namespace ga
