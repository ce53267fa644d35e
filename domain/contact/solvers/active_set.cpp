#include "domain/contact/solvers/active_set.hpp"

#include "domain/contact/solvers/advance.hpp"
#include "domain/contact/solvers/cascade.hpp"
#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/nested.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/errors.hpp"

#include <limits>
#include <optional>

namespace rough {

namespace {

/// The residual under which rounding makes further iterations pointless.
constexpr double finest = 1e-12;
/// How far the residual falls before the contact set is looked at again.
constexpr double loosening = 0.05;
/// How well displacements must be known, over the approach, while the residual is far above this.
constexpr double rough_accuracy = 1e-5;
constexpr int most_rounds = 200;
constexpr long most_iterations = 2000;
/// Up to this size a dense factor is cheaper than a coarser grid.
constexpr Index coarsest = 1024;
/// From one grid to the next coarser one; an area's nodes grow by its square.
constexpr Index line_stride = 4, area_stride = 2;

enum class Purpose { curve, guess };

class ActiveSet {
  public:
    ActiveSet(const ContactProblem& problem, const ContactOptions& options, Purpose purpose)
        : problem_(problem), options_(options), purpose_(purpose), solver_(problem), set_(problem.nodes()),
          load_(problem.nodes()), tangent_(problem.nodes()) {}

    StepSolution press(double approach, const std::optional<Eigen::VectorXd>& guess) {
        start(approach, guess);
        double tolerance = options_.tolerance;
        settle(approach, tolerance);
        if (purpose_ == Purpose::guess)
            return step_solution(set_, load_, tangent_, false);
        for (;;) {
            solver_.tangent(set_, options_.tolerance, options_.states, tangent_);
            const double error = load_error(problem_, approach, set_, load_, tangent_);
            if (error <= options_.tolerance || tolerance <= finest)
                break;
            tolerance = std::max(finest, 0.3 * tolerance * options_.tolerance / error);
            settle(approach, tolerance);
        }
        return step_solution(set_, load_, tangent_, options_.states);
    }
    const Eigen::VectorXd& pressure() const { return load_.pressure; }
    long applies() const { return solver_.applies(); }

  private:
    /// Starts from the step before, moved along its tangent or by what a coarser grid's pressures have grown
    /// since (never less, as no node's pressure falls with the load), whichever leaves the smaller residual.
    void start(double approach, const std::optional<Eigen::VectorXd>& guess) {
        Loaded grown(guess ? problem_.nodes() : 0);
        if (guess)
            grown.pressure =
                last_guess_ ? (load_.pressure + (*guess - *last_guess_).cwiseMax(0)).eval() : *guess;
        KnownProduct grown_product = product_;
        last_guess_ = guess;
        load_.pressure += (approach - approach_) * tangent_.pressure;
        approach_ = approach;
        solver_.load(load_, product_, rough_accuracy * approach);
        stale_ = false;
        if (!guess)
            return;
        solver_.load(grown, grown_product, rough_accuracy * approach);
        const double left = residual(grown, approach);
        if (left > residual(load_, approach))
            return;
        load_ = std::move(grown);
        product_ = std::move(grown_product);
        for (Index i = 0; i < problem_.nodes(); ++i)
            load_.pressure[i] > 0 ? set_.insert(i) : set_.erase(i);
        set_.collect();
        // The guess errs in its pressures more than in its set: those first.
        improve(approach, loosening * left);
    }

    void improve(double approach, double target) {
        solver_.improve(
            set_, [&](Index i) { return approach - problem_.gap[i]; }, load_, Enough{target * approach},
            most_iterations);
        stale_ = true;
    }

    double residual(const Loaded& x, double approach) const {
        double worst = 0;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double depth = approach - problem_.gap[i] - x.displacement[i];
            worst = std::max(worst, x.pressure[i] > 0 ? std::abs(depth) : depth);
        }
        return worst / approach;
    }

    void settle(double approach, double tolerance) {
        double target = 1;
        for (int round = 0; round < most_rounds; ++round) {
            check_stop(options_);
            const double least = 0.3 * std::min(target, tolerance) * approach;
            double worst = 0;
            const double accuracy = std::min(rough_accuracy, 0.1 * target) * approach;
            if (change_set(approach, least, accuracy, worst)) {
                // The next change is looked for at a residual well under what caused this one.
                target = std::max(finest, loosening * worst);
            } else if (target > tolerance) {
                target = std::max(tolerance, loosening * target);
            } else {
                // An area has nodes without number at the brink: which of them touch is as good as the
                // residual.
                const double trusted =
                    purpose_ == Purpose::guess || problem_.is_area()
                        ? target
                        : trusted_residual(problem_, approach, load_.pressure, load_.displacement);
                if (target <= finest || target <= trusted)
                    return;
                target = std::max(finest, std::clamp(trusted, loosening * target, 0.5 * target));
            }
            improve(approach, target);
        }
    }

    /// Drops the nodes under tension, adds those that penetrate by more than `least`, known to `accuracy`;
    /// false if there are none. `worst` becomes the largest residual that this leaves, over the approach.
    bool change_set(double approach, double least, double accuracy, double& worst) {
        std::vector<int> dropped;
        for (const int i : set_.nodes())
            if (!(load_.pressure[i] > 0))
                dropped.push_back(i);
        for (const int i : dropped) {
            set_.erase(i);
            load_.pressure[i] = 0;
        }
        if (stale_ || !dropped.empty())
            solver_.load(load_, product_, accuracy);
        stale_ = false;
        depth_ = approach - (problem_.gap + load_.displacement).array();
        const std::vector<int> added = dropped.empty()
                                           ? advancing_nodes(depth_, set_.touching(), problem_.shape, least)
                                           : std::vector<int>();
        for (const int i : added)
            set_.insert(i);
        if (!dropped.empty() || !added.empty())
            set_.collect();
        worst = 0;
        for (const int i : set_.nodes())
            worst = std::max(worst, std::abs(depth_[i]) / approach);
        return !dropped.empty() || !added.empty();
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    Purpose purpose_;
    SetSolver solver_;
    ContactSet set_;
    Loaded load_, tangent_;
    KnownProduct product_; ///< of load_
    Eigen::ArrayXd depth_;
    std::optional<Eigen::VectorXd> last_guess_; ///< the coarser grid's pressures at the step before
    double approach_ = 0;
    bool stale_ = true; ///< the displacement off the contact set
};

Solution guess(const ContactProblem& problem, ContactOptions options);

/// Every load step; the coarser grid goes first, as long as it is worth while.
void solve_levels(const ContactProblem& problem, const ContactOptions& options, Purpose purpose,
                  Solution& solution) {
    const bool cascade = problem.nodes() > coarsest;
    const Index stride = problem.is_area() ? area_stride : line_stride;
    const ContactProblem coarse_problem = cascade ? coarsened(problem, stride) : problem;
    const Solution coarse = cascade ? guess(coarse_problem, options) : Solution();
    ActiveSet solver(problem, options, purpose);
    SplitOperator check = split_operator(problem);
    for (std::size_t j = 0; j < problem.approach.size(); ++j) {
        const double approach = problem.approach[j];
        const long before = solver.applies();
        std::optional<Eigen::VectorXd> start;
        if (j < coarse.steps.size())
            start = refined_pressures(coarse.steps[j], coarse_problem.shape, stride, problem.shape);
        StepSolution found = solver.press(approach, start);
        if (purpose == Purpose::curve) {
            const Eigen::VectorXd displacement = check.apply(solver.pressure());
            found.residual =
                certify(problem, approach, found.nodes, found.pressure, displacement.data()).residual();
            if (!(found.residual <= 2 * options.tolerance))
                fail("active set", problem, approach, found.residual, options.tolerance);
        }
        solution.steps.push_back(std::move(found));
        solution.iterations += solver.applies() - before;
    }
}

/// A coarse grid's solution, or as much of it as there is: it is a start for the fine grid, nothing hangs on
/// it.
Solution guess(const ContactProblem& problem, ContactOptions options) {
    options.tolerance = 1e-2;
    options.states = false;
    Solution solution;
    try {
        if (problem.nodes() <= coarsest)
            solve_nested(problem, options, std::numeric_limits<double>::infinity(), solution);
        else
            solve_levels(problem, options, Purpose::guess, solution);
    } catch (const NotConverged&) {
        check_stop(options);
        return {};
    }
    return solution;
}

} // namespace

Solution solve_active_set(const ContactProblem& problem, const ContactOptions& options) {
    Solution solution;
    solve_active_set(problem, options, solution);
    return solution;
}

void solve_active_set(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_levels(problem, options, Purpose::curve, solution);
}

} // namespace rough
