#pragma once

#include "ga/variation/cross.hpp"
#include "ga/variation/genes.hpp"

#include <algorithm>

namespace ga {

/// BLX-alpha (Eshelman and Schaffer 1993): each gene of both children is uniform between the parents' genes,
/// on an interval longer by alpha times their distance at either end, cut at the bounds.
struct Blend {
    double alpha; ///< part of the parents' distance, >= 0

    ///@{
    /// What every way of crossing has (Crosses).
    std::string text() const { return "blend " + number(alpha); }

    template <HasGenes P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        edit_genes(problem, a, [&](std::span<double> first) {
            edit_genes(problem, b, [&](std::span<double> second) {
                for (const Variable& variable : variables_of(problem, a)) {
                    if (variable.gene >= first.size() || variable.gene >= second.size())
                        continue;
                    double &x = first[variable.gene], &y = second[variable.gene];
                    const double low = std::min(x, y), high = std::max(x, y), reach = alpha * (high - low);
                    for (double* child : {&x, &y})
                        *child = std::clamp(stream.uniform(low - reach, high + reach), variable.lower,
                                            variable.upper);
                }
            });
        });
    }
    ///@}
};

/// @param alpha  >= 0; 0.5 neither widens nor narrows a population's spread too soon
inline Blend blend(double alpha = 0.5) {
    if (!(alpha >= 0))
        throw UsageError("cross blend: alpha is " + number(alpha) + "; expected 0 or more");
    return {alpha};
}

} // namespace ga
