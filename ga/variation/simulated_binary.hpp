#pragma once

#include "ga/variation/cross.hpp"
#include "ga/variation/genes.hpp"

#include <algorithm>
#include <cmath>

namespace ga {

/// Simulated binary cross-over (Deb and Agrawal 1995, with bounds as in NSGA-II's code): each gene with
/// probability 1/2; the children lie symmetrically about the parents' mean, spread as one-point cross-over
/// spreads binary strings.
struct SimulatedBinary {
    double eta = 15; ///< greater: children nearer to their parents

    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() {
        return {"sbx", "cross-over", "simulated binary cross-over, symmetric about the parents' mean"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.eta, number("eta", "15", 0, no_limit, "the greater, the nearer to the parents"));
    }

    template <HasGenes P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        cross_genes(problem, a, b, [&](double& x, double& y, const Variable& variable) {
            if (stream.chance(0.5))
                cross(x, y, variable, stream);
        });
    }
    ///@}

  private:
    void cross(double& x, double& y, const Variable& variable, Stream& stream) const {
        const double low = std::min(x, y), high = std::max(x, y), distance = high - low;
        const double u = stream.uniform();
        const bool exchanged = stream.chance(0.5);
        if (!(distance > 1e-14 * std::max(1.0, std::abs(low) + std::abs(high))))
            return;
        // The spread whose density is cut where a child would leave the bounds.
        const auto spread = [&](double room) {
            const double alpha = 2 - std::pow(1 + 2 * room / distance, -(eta + 1)); // 2 without a bound
            return std::pow(u <= 1 / alpha ? u * alpha : 1 / (2 - u * alpha), 1 / (eta + 1));
        };
        const auto inside = [&](double gene) { return std::clamp(gene, variable.lower, variable.upper); };
        const double middle = (low + high) / 2;
        const double below = inside(middle - spread(low - variable.lower) * distance / 2);
        const double above = inside(middle + spread(variable.upper - high) * distance / 2);
        x = exchanged ? above : below;
        y = exchanged ? below : above;
    }
};

/// @param eta  distribution index, >= 0: the greater, the nearer children stay to their parents
inline SimulatedBinary sbx(double eta = 15) { return {eta}; }

} // namespace ga
