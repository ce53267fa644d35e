#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

using Eigen::VectorXd;

class LawsonHanson {
  public:
    LawsonHanson(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), options_(options), fourier_(fourier_operator(problem)),
          passive_(static_cast<std::size_t>(problem.nodes())), influence_(problem.column, problem.shape),
          direct_(influence_), factor_(influence_, problem.gap) {}

    StepSolution solve_step(double approach, std::optional<double>) {
        const long limit = iterations_ + 3 * problem_.nodes();
        reach_solution(approach);
        while (iterations_ < limit) {
            check_stop(options_);
            const Index worst = max_violated(approach);
            if (worst < 0 || factor_.append({static_cast<int>(worst)}) == 0) break;
            passive_[static_cast<std::size_t>(worst)] = 1;
            pressure_.conservativeResize(factor_.size());
            pressure_[factor_.size() - 1] = 0;
            ++iterations_;
            reach_solution(approach);
            // A sum over the passive set at every node, the factor's last row and its solution.
            const double size = static_cast<double>(factor_.size());
            work_ += size * (static_cast<double>(problem_.nodes()) + size);
            if (work_ > problem_.work_limit) throw NotConverged("NNLS needs too much work");
        }
        const double* u = fourier_.apply(factor_.nodes(), pressure_);
        const double residual = certify(problem_, approach, factor_.nodes(), pressure_, u).residual();
        StepSolution step{factor_.nodes(), pressure_, factor_.stiffness(), {}, residual, 0, approach};
        expect_residual("NNLS", problem_, step, direct_tolerance(problem_, step));
        if (options_.states) factor_.tangent(step.tangent);
        return step;
    }

    long iterations() const { return iterations_; }

  private:
    /// Moves from the feasible pressures towards those of the passive set, and drops the nodes that reach zero before.
    void reach_solution(double approach) {
        VectorXd goal;
        while (factor_.size() > 0) {
            factor_.pressures(approach, goal);
            double step = 1;
            for (Index k = 0; k < goal.size(); ++k)
                if (!(goal[k] > 0))
                    step = std::min(step, pressure_[k] > 0 ? pressure_[k] / (pressure_[k] - goal[k]) : 0.0);
            if (goal.minCoeff() > 0) {
                pressure_ = goal;
                return;
            }
            pressure_ += step * (goal - pressure_);
            const double zero = std::numeric_limits<double>::epsilon() * pressure_.maxCoeff();
            std::vector<Index> dropped;
            Index kept = 0;
            for (Index k = 0; k < factor_.size(); ++k)
                if (goal[k] > 0 || pressure_[k] > zero)
                    pressure_[kept++] = pressure_[k];
                else
                    dropped.push_back(k);
            for (const Index k : dropped)
                passive_[static_cast<std::size_t>(factor_.nodes()[static_cast<std::size_t>(k)])] = 0;
            factor_.remove(dropped);
            pressure_.conservativeResize(kept);
            ++iterations_;
        }
    }

    /// The node that violates the gap most, or -1.
    Index max_violated(double approach) {
        const double* u = direct_.apply(factor_.nodes(), pressure_);
        Index worst = -1;
        double deepest = gap_rounding * approach;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double depth = approach - problem_.gap[i] - u[i];
            if (depth > deepest && !passive_[static_cast<std::size_t>(i)]) {
                deepest = depth;
                worst = i;
            }
        }
        return worst;
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    FourierOperator fourier_;
    std::vector<char> passive_;
    Influence influence_;
    DirectOperator direct_;
    GrowingFactor factor_; ///< its nodes are the passive set
    VectorXd pressure_;    ///< on the passive set
    long iterations_ = 0;
    double work_ = 0; ///< multiplications
};

} // namespace

void solve_nnls(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_steps<LawsonHanson>(problem, options, solution);
}

} // namespace rough
