#pragma once

#include "apps/experiments/solvers/trial.hpp"

#include <map>

/// Scenes in which contact solvers may fail, and what a result is verified by.
namespace app {

/// A scene in which some method may fail, on one kernel.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All of them, by the names of the stability table; a scene stands once for every kernel where it makes
/// sense.
std::vector<StabilityScene> stability_scenes();

/// What a scene's results are verified by: on small grids the oracle, asked also a tolerance below and above
/// each displacement, so that a node that just touches may count either way; on large ones the direct and the
/// iterative solvers verify each other.
class StabilityReference {
  public:
    explicit StabilityReference(const StabilityScene& scene) : scene_(scene) {}

    /// Turns a solved trial into a wrong one where it differs by more than the tolerance.
    void verifier(ContactTrial& trial, double tolerance);

  private:
    /// What a displacement's results may be: pressure, stiffness and number of contact nodes, the lowest and
    /// the highest.
    using Span = std::array<std::pair<double, double>, 3>;
    std::vector<Span> by_another(rough::Solver verified) const;
    const std::vector<Span>& spans(double tolerance);

    const StabilityScene& scene_;
    std::map<double, std::vector<Span>> spans_; ///< the oracle's, by tolerance
};

} // namespace app
