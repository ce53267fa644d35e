#include "domain/contact/solvers/nnls.hpp"

#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/direct.hpp"
#include "domain/errors.hpp"

#include <Eigen/Jacobi>

#include <limits>

namespace rough {

namespace {

using Eigen::Upper;
using Eigen::VectorXd;

constexpr double rounding = 1e-13;

/// R'R = H_AA on the passive set A, with z = R'^-1 1 and v = R'^-1 g0_A beside it as two more columns.
class PassiveFactor {
  public:
    Index size() const { return static_cast<Index>(nodes_.size()); }
    const std::vector<int>& nodes() const { return nodes_; }

    /// false, and nothing appended, if the pivot is not positive
    bool append(int node, double gap, const Influence& influence) {
        const Index m = size();
        if (m == R_.rows()) {
            R_.conservativeResize(2 * m + 16, 2 * m + 16);
            images_.conservativeResize(2 * m + 16, 2);
        }
        auto r = R_.col(m).head(m);
        for (Index k = 0; k < m; ++k)
            r[k] =
                influence
                    .centre()[influence.place(nodes_[static_cast<std::size_t>(k)]) - influence.place(node)];
        R_.topLeftCorner(m, m).triangularView<Upper>().transpose().solveInPlace(r);
        const double pivot = influence.centre()[0] - r.squaredNorm();
        if (!(pivot > 1e-10 * influence.centre()[0]))
            return false;
        const double diagonal = std::sqrt(pivot);
        R_(m, m) = diagonal;
        images_.row(m) = (Eigen::RowVector2d(1, gap) - r.transpose() * images_.topRows(m)) / diagonal;
        nodes_.push_back(node);
        return true;
    }

    /// Removes the node at a position; Givens rotations make the rest triangular again.
    void remove(Index position) {
        const Index m = size();
        for (Index k = position; k + 1 < m; ++k) {
            R_.col(k).head(k + 2) = R_.col(k + 1).head(k + 2);
        }
        for (Index k = position; k + 1 < m; ++k) {
            Eigen::JacobiRotation<double> rotation;
            rotation.makeGivens(R_(k, k), R_(k + 1, k));
            R_.block(0, k, m, m - 1 - k).applyOnTheLeft(k, k + 1, rotation.adjoint());
            images_.topRows(m).applyOnTheLeft(k, k + 1, rotation.adjoint());
        }
        nodes_.erase(nodes_.begin() + position);
    }

    VectorXd solve(double approach) const {
        VectorXd p = images_.topRows(size()) * Eigen::Vector2d(approach, -1);
        R_.topLeftCorner(size(), size()).triangularView<Upper>().solveInPlace(p);
        return p;
    }
    VectorXd tangent() const {
        VectorXd w = images_.col(0).head(size());
        R_.topLeftCorner(size(), size()).triangularView<Upper>().solveInPlace(w);
        return w;
    }
    double stiffness() const { return images_.col(0).head(size()).squaredNorm(); }

  private:
    Eigen::MatrixXd R_;
    Eigen::Matrix<double, Eigen::Dynamic, 2> images_;
    std::vector<int> nodes_;
};

class LawsonHanson {
  public:
    LawsonHanson(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), options_(options), fourier_(fourier_operator(problem)),
          passive_(static_cast<std::size_t>(problem.nodes())), influence_(problem.column, problem.shape),
          direct_(influence_) {}

    StepSolution press(double approach) {
        const long limit = iterations_ + 3 * problem_.nodes();
        reach_solution(approach);
        while (iterations_ < limit) {
            check_stop(options_);
            const Index worst = most_violated(approach);
            if (worst < 0 || !factor_.append(static_cast<int>(worst), problem_.gap[worst], influence_))
                break;
            passive_[static_cast<std::size_t>(worst)] = 1;
            pressure_.conservativeResize(factor_.size());
            pressure_[factor_.size() - 1] = 0;
            ++iterations_;
            reach_solution(approach);
        }
        StepSolution step{factor_.nodes(), pressure_, factor_.stiffness(), {}, residual(approach)};
        const double tolerance = direct_tolerance(problem_, approach, pressure_, step.stiffness);
        if (!(step.residual <= tolerance))
            fail("NNLS", problem_, approach, step.residual, tolerance);
        if (options_.states)
            step.tangent = factor_.tangent();
        return step;
    }

    long iterations() const { return iterations_; }

  private:
    /// Walks from the feasible pressures to those of the passive set, dropping the nodes that reach zero on
    /// the way.
    void reach_solution(double approach) {
        while (factor_.size() > 0) {
            const VectorXd goal = factor_.solve(approach);
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
            for (Index k = factor_.size() - 1; k >= 0; --k) {
                if (goal[k] > 0 || pressure_[k] > zero)
                    continue;
                passive_[static_cast<std::size_t>(factor_.nodes()[static_cast<std::size_t>(k)])] = 0;
                factor_.remove(k);
                pressure_.segment(k, pressure_.size() - 1 - k) =
                    pressure_.tail(pressure_.size() - 1 - k).eval();
                pressure_.conservativeResize(pressure_.size() - 1);
            }
            ++iterations_;
        }
    }

    /// The node where the gap is violated most, or -1.
    Index most_violated(double approach) {
        const double* u = direct_.apply(factor_.nodes(), pressure_);
        Index worst = -1;
        double most = rounding * approach;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double depth = approach - problem_.gap[i] - u[i];
            if (depth > most && !passive_[static_cast<std::size_t>(i)]) {
                most = depth;
                worst = i;
            }
        }
        return worst;
    }

    double residual(double approach) {
        double* p = fourier_.input();
        std::fill_n(p, problem_.nodes(), 0.0);
        for (Index k = 0; k < factor_.size(); ++k)
            p[factor_.nodes()[static_cast<std::size_t>(k)]] = pressure_[k];
        return certify(problem_, approach, factor_.nodes(), pressure_, fourier_.apply()).residual();
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    FourierOperator fourier_;
    PassiveFactor factor_;
    std::vector<char> passive_;
    Influence influence_;
    DirectOperator direct_;
    VectorXd pressure_; ///< on the passive set
    long iterations_ = 0;
};

} // namespace

Solution solve_nnls(const ContactProblem& problem, const ContactOptions& options) {
    LawsonHanson solver(problem, options);
    Solution solution;
    for (const double approach : problem.approach)
        solution.steps.push_back(solver.press(approach));
    solution.iterations = solver.iterations();
    return solution;
}

} // namespace rough
