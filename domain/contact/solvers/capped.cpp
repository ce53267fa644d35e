#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/contact/solvers/solvers.hpp"

#include <cmath>

namespace rough {
namespace {

/// Residual of the gaps, over the approach, at which a step is solved.
constexpr double gap_tolerance = 1e-11;
/// Factor by which the residual falls before the bounds are examined again.
constexpr double falling = 0.01;
/// Armijo's share of the descent that the gradient predicts.
constexpr double share = 1e-4;
constexpr int max_projections = 500, max_halvings = 40;
constexpr long max_newton_iterations = 2000;
constexpr double tangent_tolerance = 1e-10;

/// Pressures within bounds at each node, by Bertsekas' projected Newton method (1982).
class BoundedPressures {
  public:
    BoundedPressures(const ContactProblem& problem, const ContactOptions& options, Eigen::VectorXd lower,
                     Eigen::VectorXd upper)
        : problem_(problem), options_(options), lower_(std::move(lower)), upper_(std::move(upper)), solver_(problem),
          check_(problem.column, problem.shape, *problem.team), free_(problem.nodes()), load_(problem.nodes()),
          tangent_(problem.nodes()) {}

    /// Presses until the gaps to `goal` are small against the approach.
    void solve(double approach, Eigen::VectorXd goal) {
        goal_ = std::move(goal);
        solver_.update(load_);
        const double enough = gap_tolerance * approach;
        double worst = std::numeric_limits<double>::infinity();
        for (int round = 0; round < max_projections; ++round) {
            check_stop(options_);
            raise(enough);
            const double before = worst;
            worst = find_free(0.5 * enough);
            // Rounding may allow no better; the certificate verifies.
            if (worst <= enough || (worst >= 0.5 * before && worst <= 100 * enough)) break;
            if (!descend(std::max(0.1 * enough, falling * worst))) break;
        }
    }

    /// The pressures on `nodes`, with the stiffness of those between the bounds.
    StepSolution solution(double approach, std::vector<int> nodes) {
        ContactSet elastic(problem_.nodes());
        elastic.assign([&](Index i) { return load_.pressure[i] > lower_[i] && load_.pressure[i] < upper_[i]; });
        if (problem_.is_singular() && static_cast<Index>(elastic.nodes().size()) == problem_.nodes())
            elastic.assign([&](Index i) { return free_.holds(i); }); // without the lowest node
        solver_.tangent(elastic, tangent_tolerance, true, tangent_);
        StepSolution step = step_solution(elastic, load_, tangent_, false);
        step.approach = approach;
        step.nodes = std::move(nodes);
        step.held = static_cast<Index>(step.nodes.size() - elastic.nodes().size());
        step.pressure = load_.pressure(step.nodes);
        if (options_.states) step.tangent = tangent_.pressure(step.nodes);
        return step;
    }

    const Eigen::VectorXd& pressure() const { return load_.pressure; }
    SplitOperator& check() { return check_; } ///< H by another path
    long applies() const { return solver_.applies(); }

  private:
    /// Frees the nodes between the bounds and those that a bound holds back; returns their largest residual.
    double find_free(double negligible) {
        double worst = 0;
        Index deepest = 0, count = 0;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double p = load_.pressure[i], gap = load_.displacement[i] - goal_[i];
            if ((p <= lower_[i] && gap >= -negligible) || (p >= upper_[i] && gap <= negligible) ||
                !(lower_[i] < upper_[i])) {
                free_.erase(i);
                continue;
            }
            free_.insert(i);
            ++count;
            worst = std::max(worst, std::abs(gap));
            if (problem_.gap[i] > problem_.gap[deepest]) deepest = i;
        }
        // All nodes of a periodic profile together have a singular matrix; the lowest one can wait.
        if (problem_.is_singular() && count == problem_.nodes()) free_.erase(deepest);
        free_.collect();
        return worst;
    }

    /// Takes one projected Newton step; false if none descends any more.
    bool descend(double residual) {
        SurfaceState newton = load_;
        solver_.improve(
            free_, [&](Index i) { return goal_[i]; }, newton, Enough{residual}, max_newton_iterations);
        const Eigen::VectorXd direction = newton.pressure - load_.pressure;
        SurfaceState next(problem_.nodes());
        double length = 1;
        for (int halving = 0; halving < max_halvings; ++halving, length /= 2) {
            next.pressure = (load_.pressure + length * direction).cwiseMax(lower_).cwiseMin(upper_);
            solver_.update(next);
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

    /// Raises all pressures of a periodic body by one value until a node reaches its upper bound. It does so if the
    /// approach is beyond that of full contact. Equal pressures displace nothing, so this lowers the energy.
    void raise(double negligible) {
        if (!problem_.is_singular() || goal_.mean() <= negligible) return;
        Index highest = 0;
        const double change = (upper_ - load_.pressure).minCoeff(&highest);
        if (change <= 0 || !std::isfinite(change)) return;
        load_.pressure = (load_.pressure.array() + change).matrix().cwiseMin(upper_);
        load_.pressure[highest] = upper_[highest];
        solver_.update(load_);
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    Eigen::VectorXd lower_, upper_, goal_;
    SetSolver solver_;
    SplitOperator check_;
    ContactSet free_;
    SurfaceState load_, tangent_;
};

class CappedContact {
  public:
    CappedContact(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), bounded_(problem, options, Eigen::VectorXd::Zero(problem.nodes()),
                                      Eigen::VectorXd::Constant(problem.nodes(), problem.cap)) {}

    StepSolution solve_step(double approach, std::optional<double>) {
        bounded_.solve(approach, (approach - problem_.gap.array()).matrix());
        StepSolution step = bounded_.solution(
            approach, problem_.team->where(problem_.nodes(), [&](Index i) { return bounded_.pressure()[i] > 0; }));
        certify_step("projected Newton's method", problem_, step, bounded_.check(), bounded_.pressure(),
                     direct_tolerance(problem_, step));
        return step;
    }
    long iterations() const { return bounded_.applies(); }

  private:
    const ContactProblem& problem_;
    BoundedPressures bounded_;
};

} // namespace

void solve_capped(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_steps<CappedContact>(problem, options, solution);
}

void solve_slip(const ContactProblem& problem, const Eigen::VectorXd& limit, const ContactOptions& options,
                Solution& solution) {
    BoundedPressures bounded(problem, options, -limit, limit);
    const Eigen::VectorXd& traction = bounded.pressure();
    const std::vector<int> touching = problem.team->where(problem.nodes(), [&](Index i) { return limit[i] > 0; });
    for (const double moved : problem.approach) {
        bounded.solve(moved, Eigen::VectorXd::Constant(problem.nodes(), moved));
        StepSolution step = bounded.solution(moved, touching);
        const Eigen::VectorXd displacement = bounded.check().apply(traction);
        for (const int i : touching) {
            const double ahead = displacement[i] - moved;
            step.residual = std::max(step.residual, traction[i] >= limit[i]    ? ahead
                                                    : traction[i] <= -limit[i] ? -ahead
                                                                               : std::abs(ahead));
        }
        if (moved > 0) step.residual /= moved;
        expect_residual("partial slip", problem, step, direct_tolerance(problem, step));
        solution.steps.push_back(std::move(step));
    }
    solution.iterations += bounded.applies();
}

} // namespace rough
