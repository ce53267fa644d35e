#pragma once

#include "apps/experiments/solvers/trial.hpp"

#include <map>

/// Scenes in which contact solvers may fail, and the verification of their results.
namespace app {

/// A scene on one kernel in which some method may fail.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All scenes, named as in the stability table. A scene appears once for each kernel to which it applies.
std::vector<StabilityScene> stability_scenes();

/// Verifies the results of a scene. On small grids the oracle gives the reference. It is evaluated a
/// tolerance below and above each displacement, too, so that a node that just touches may count or not. On
/// large grids the direct and the iterative solvers verify each other.
class StabilityReference {
  public:
    explicit StabilityReference(const StabilityScene& scene) : scene_(scene) {}

    /// Turns a solved trial into a wrong one if it differs by more than the tolerance.
    void verifier(ContactTrial& trial, double tolerance);

  private:
    /// Lowest and highest allowed pressure, stiffness and number of contact nodes at a displacement.
    using Span = std::array<std::pair<double, double>, 3>;
    std::vector<Span> by_another(rough::Solver verified) const;
    const std::vector<Span>& spans(double tolerance);

    const StabilityScene& scene_;
    std::map<double, std::vector<Span>> spans_; ///< from the oracle, by tolerance
};

} // namespace app
