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
inline Method nlopt_method(const std::string& name, int evaluations) { return method_of(Nlopt{name, evaluations}); }

/// A function of the residuals that a search maximises, with its derivatives.
struct ResidualMerit {
    double value;                                        ///< higher is better
    double merit;                                        ///< ranks points, higher is better
    std::vector<std::pair<Eigen::Index, double>> slopes; ///< rows k and d value / d r_k, if it is not 0
};

/// Minus the largest |r_k| of the residuals r. The slope is taken from the first row k with this value.
ResidualMerit minus_largest(const Eigen::VectorXd& residuals);

/// Maximises a function of the residuals by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA). `read` returns the function's value and derivatives for given residuals.
/// @param evaluations  maximum number of evaluations after the start point; inner iterations count
Eigen::VectorXd maximised_by_mma(const Landscape& land, int evaluations,
                                 const std::function<ResidualMerit(const Eigen::VectorXd&)>& read);

/// The method `mma n`: maximised_by_mma() with minus_largest(). A domain can make a method with another
/// function of the residuals.
struct Mma {
    static constexpr bool on_residuals = true; ///< whether it uses residuals and their derivatives

    int evaluations = 1; ///< maximum number of evaluations after the start point, >= 1

    static Words words() { return {"mma", "refinement", "GCMMA on the largest |r|, one row at a time"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }
    /// The best point found (Method).
    Eigen::VectorXd improve(const Landscape& land) const;
};

/// The method `mma evaluations`.
inline ResidualMethod mma(int evaluations) { return method_of(Mma{evaluations}); }

/// Minimises the largest |r_k| by the globally convergent method of moving asymptotes (Svanberg 2002; NLopt's
/// LD_MMA). The problem is smooth: minimise t subject to r_k - t <= 0 and -r_k - t <= 0, with t as one more
/// variable. `mma` uses one row at a time, and this method all rows.
struct Minimax {
    static constexpr bool on_residuals = true; ///< whether it uses residuals and their derivatives

    int evaluations = 1; ///< maximum number of evaluations after the start point, >= 1; inner ones count

    static Words words() { return {"minimax", "refinement", "GCMMA on the smallest t with -t <= r <= t"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }

    /// The best point found (Method).
    Eigen::VectorXd improve(const Landscape& land) const;
};

/// The method `minimax evaluations`.
inline ResidualMethod minimax(int evaluations) { return method_of(Minimax{evaluations}); }

} // namespace ga
