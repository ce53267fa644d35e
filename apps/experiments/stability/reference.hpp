#pragma once

#include "apps/experiments/stability/scenes.hpp"

#include <map>
#include <optional>

namespace app {

/// What a scene's results are verified by: on small grids the oracle, asked also a tolerance below and above
/// each displacement, so that a node that just touches may count either way; on large ones the direct and the
/// iterative solvers verifier each other.
class StabilityReference {
  public:
    explicit StabilityReference(const StabilityScene& scene);

    /// Turns a solved trial into a wrong one where it differs by more than the tolerance.
    void verifier(ContactTrial& trial, double tolerance);

  private:
    /// What a displacement's results may be.
    struct Span {
        double least_pressure, most_pressure, least_stiffness, most_stiffness;
        rough::Index least_nodes, most_nodes;
    };
    std::optional<rough::ContactCurve> by_another(rough::Solver verified) const;
    const std::vector<Span>& spans(double tolerance);
    std::string difference(const rough::LoadStep& step, std::size_t j, const Span& span,
                           double tolerance) const;

    const StabilityScene& scene_;
    std::map<double, std::vector<Span>> spans_; ///< the oracle's, by tolerance
};

} // namespace app
