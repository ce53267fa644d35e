#pragma once

#include "ga/variation/cross.hpp"
#include "ga/variation/genes.hpp"

#include <algorithm>

namespace ga {

/// BLX-alpha (Eshelman and Schaffer 1993): each gene of both children is uniform between the parents' genes,
/// on an interval longer by alpha times their distance at either end, cut at the bounds.
struct Blend {
    double alpha = 0.5; ///< part of the parents' distance, >= 0

    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() {
        return {"blend", "cross-over", "draws each gene uniformly around the parents' (BLX-alpha)"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.alpha, number("alpha", "0.5", 0, no_limit, "how far beyond, in their distance"));
    }

    template <HasGenes P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        cross_genes(problem, a, b, [&](double& x, double& y, const Variable& variable) {
            const double low = std::min(x, y), high = std::max(x, y), reach = alpha * (high - low);
            for (double* child : {&x, &y})
                *child =
                    std::clamp(stream.uniform(low - reach, high + reach), variable.lower, variable.upper);
        });
    }
    ///@}
};

/// @param alpha  >= 0; 0.5 neither widens nor narrows a population's spread too soon
inline Blend blend(double alpha = 0.5) { return {alpha}; }

} // namespace ga
