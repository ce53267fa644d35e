#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/contact/solvers/solvers.hpp"

#include <cmath>

namespace rough {

namespace {

/// Residual of the gaps, over the approach, at which a step is solved.
constexpr double settled = 1e-11;
/// Factor by which the residual falls before the bounds are examined again.
constexpr double falling = 0.01;
/// Armijo's share of the descent that the gradient predicts.
constexpr double share = 1e-4;
constexpr int max_projections = 500, max_halvings = 40;
constexpr long max_newton_iterations = 2000;
constexpr double tangent_tolerance = 1e-10;

class CappedContact {
  public:
    CappedContact(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), options_(options), solver_(problem),
          check_(problem.column, problem.shape, *problem.team), free_(problem.nodes()),
          load_(problem.nodes()), tangent_(problem.nodes()) {}

    StepSolution press(double approach, std::optional<double>) {
        goal_ = (approach - problem_.gap.array()).matrix();
        solver_.load(load_);
        const double enough = settled * approach;
        double worst = std::numeric_limits<double>::infinity();
        for (int round = 0; round < max_projections; ++round) {
            check_stop(options_);
            raise(enough);
            const double before = worst;
            worst = find_free(0.5 * enough);
            // Rounding may allow no better; the certificate verifies.
            if (worst <= enough || (worst >= 0.5 * before && worst <= 100 * enough))
                break;
            if (!descend(std::max(0.1 * enough, falling * worst)))
                break;
        }
        return solution(approach);
    }
    long iterations() const { return solver_.applies(); }

  private:
    /// Frees the nodes between the bounds and those that a bound holds back; returns their largest residual.
    double find_free(double negligible) {
        double worst = 0;
        Index deepest = 0, count = 0;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double p = load_.pressure[i], gap = load_.displacement[i] - goal_[i];
            if ((p <= 0 && gap >= -negligible) || (p >= problem_.cap && gap <= negligible)) {
                free_.erase(i);
                continue;
            }
            free_.insert(i);
            ++count;
            worst = std::max(worst, std::abs(gap));
            if (problem_.gap[i] > problem_.gap[deepest])
                deepest = i;
        }
        // All nodes of a periodic profile together have a singular matrix; the lowest one can wait.
        if (problem_.is_singular() && count == problem_.nodes())
            free_.erase(deepest);
        free_.collect();
        return worst;
    }

    /// Takes one projected Newton step; false if none descends any more.
    bool descend(double residual) {
        Loaded newton = load_;
        solver_.improve(
            free_, [&](Index i) { return goal_[i]; }, newton, Enough{residual}, max_newton_iterations);
        const Eigen::VectorXd direction = newton.pressure - load_.pressure;
        Loaded next(problem_.nodes());
        double length = 1;
        for (int halving = 0; halving < max_halvings; ++halving, length /= 2) {
            next.pressure = (load_.pressure + length * direction).cwiseMax(0).cwiseMin(problem_.cap);
            solver_.load(next);
            const Eigen::VectorXd step = next.pressure - load_.pressure;
            const double promised = step.dot(load_.displacement - goal_);
            // A quadratic changes by the mean of its gradients at both ends.
            const double change = 0.5 * (promised + step.dot(next.displacement - goal_));
            if (promised < 0 && change <= share * promised) {
                std::swap(load_, next);
                return true;
            }
        }
        return false;
    }

    /// Raises all pressures of a periodic body by one value until a node reaches the hardness, if the
    /// approach is beyond that of full contact. Equal pressures displace nothing, so this lowers the energy.
    void raise(double negligible) {
        if (!problem_.is_singular() || goal_.mean() <= negligible)
            return;
        Index highest = 0;
        const double change = problem_.cap - load_.pressure.maxCoeff(&highest);
        if (change <= 0)
            return;
        load_.pressure = (load_.pressure.array() + change).cwiseMin(problem_.cap);
        load_.pressure[highest] = problem_.cap;
        solver_.load(load_);
    }

    StepSolution solution(double approach) {
        ContactSet touching(problem_.nodes()), elastic(problem_.nodes());
        touching.assign([&](Index i) { return load_.pressure[i] > 0; });
        elastic.assign([&](Index i) { return load_.pressure[i] > 0 && load_.pressure[i] < problem_.cap; });
        solver_.tangent(elastic, tangent_tolerance, true, tangent_);
        StepSolution step = step_solution(elastic, load_, tangent_, false);
        step.approach = approach;
        step.nodes = touching.nodes();
        step.held = static_cast<Index>(step.nodes.size() - elastic.nodes().size());
        step.pressure = load_.pressure(step.nodes);
        if (options_.states)
            step.tangent = tangent_.pressure(step.nodes);
        certify_step("capped active set", problem_, step, check_, load_.pressure,
                     direct_tolerance(problem_, step));
        return step;
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    SetSolver solver_;
    SplitOperator check_;
    ContactSet free_;
    Loaded load_, tangent_;
    Eigen::VectorXd goal_; ///< Delta - g0
};

} // namespace

void solve_capped(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_steps<CappedContact>(problem, options, solution);
}

} // namespace rough
