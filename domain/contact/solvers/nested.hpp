#pragma once

#include "domain/contact/solvers/direct.hpp"
#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/problem.hpp"

#include <limits>
#include <optional>

namespace rough {

/// The direct solver, one load step after the other on one factor: contact sets are nested (w > 0), so one
/// bordered Cholesky factor grows through all load steps. The set of nodes that penetrate under the pressures
/// of the step before contains the new contact set, and dropping the nodes under tension from it keeps it so;
/// each step is therefore one sweep of additions and some of removals.
class NestedContact {
  public:
    /// Both must outlive it. `most_work`: multiplications of the factor after which it gives up.
    NestedContact(const ContactProblem& problem, const ContactOptions& options,
                  double most_work = std::numeric_limits<double>::infinity());

    /// The solution at an approach (in units of the problem, above the one before). Throws InputError if the
    /// factor would take more than `memory_limit` bytes, NotConverged if it does not settle or has worked
    /// more than allowed.
    StepSolution press(double approach) { return press(approach, {}); }
    /// The solution at a load, a sum of pressures above the one before; the approach follows from the factor.
    StepSolution press_to(double load);
    /// Sweeps of additions or removals so far.
    long rounds() const { return rounds_; }

  private:
    StepSolution press(double approach, std::optional<double> load);
    const double* displacement();
    void find_pressures(double& approach, std::optional<double> load);
    void drop_tension(double& approach, std::optional<double> load);
    bool add_penetrating(double approach, const double* u, bool by_load);
    void eliminate(Index rows);

    const ContactProblem& problem_;
    const ContactOptions& options_;
    Influence influence_;
    GrowingFactor factor_;
    DirectOperator direct_;                  ///< while contact is slight
    std::optional<FourierOperator> fourier_; ///< beyond
    std::vector<char> touching_;
    Eigen::VectorXd pressure_;
    Eigen::ArrayXd depth_;
    long rounds_ = 0;
    double most_work_, work_ = 0;
};

/// Every load step of the problem, added to `solution`, which keeps what was solved if this throws. Throws
/// what `press` throws.
void solve_nested(const ContactProblem& problem, const ContactOptions& options, double most_work,
                  Solution& solution);

/// Throws InputError if a factor of so many nodes would take more than the options' memory.
void refuse_factor(Index nodes, const ContactOptions& options);

} // namespace rough
