#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/contact/solvers/solvers.hpp"

namespace rough {
namespace {

using Eigen::ArrayXd;

constexpr long max_gradient_steps = 5000;

class PolonskyKeer {
  public:
    PolonskyKeer(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), options_(options), solver_(problem), check_(problem.column, problem.shape, *problem.team),
          set_(problem.nodes()), load_(problem.nodes()), direction_(problem.nodes()), tangent_(problem.nodes()) {}

    /// One step to an approach, or to a load if one is given.
    StepSolution solve_step(double approach, std::optional<double> load) {
        if (load) {
            const double sum = load_.pressure.sum();
            if (sum > 0)
                load_.pressure *= *load / sum;
            else
                load_.pressure.setConstant(*load / static_cast<double>(problem_.nodes()));
        } else if (load_.pressure.maxCoeff() == 0) { // the overlap, scaled to the lowest energy
            load_.pressure = (approach - problem_.gap.array()).max(0);
            solver_.update(load_);
            const double work = load_.pressure.dot(load_.displacement);
            if (work > 0) load_.pressure *= load_.pressure.squaredNorm() / work;
        }
        for (double tolerance = options_.tolerance;;) {
            iterate(approach, load, tolerance);
            set_.assign([&](Index i) { return load_.pressure[i] > 0; });
            solver_.tangent(set_, options_.tolerance, options_.states, tangent_);
            const double error =
                std::abs(missing_load(problem_, approach, set_, load_, tangent_)) / load_.pressure.sum();
            if (error <= options_.tolerance || tolerance <= finest_residual) break;
            tolerance = std::max(finest_residual, 0.3 * tolerance * options_.tolerance / error);
        }
        StepSolution step = step_solution(set_, load_, tangent_, options_.states);
        step.approach = approach;
        certify_step("Polonsky-Keer", problem_, step, check_, load_.pressure, 2 * options_.tolerance);
        return step;
    }

    long iterations() const { return iterations_; }

  private:
    void iterate(double& approach, std::optional<double> load, double target) {
        direction_.pressure.setZero();
        double previous = 1, residual = 1;
        bool conjugate = false;
        for (long iteration = 0; iteration < max_gradient_steps; ++iteration) {
            if (iteration % 16 == 0) check_stop(options_);
            auto& p = load_.pressure;
            solver_.update(load_);
            const Eigen::Array<bool, Eigen::Dynamic, 1> contact = p.array() > 0;
            const double count = static_cast<double>(contact.count());
            if (load) approach = contact.select(problem_.gap + load_.displacement, 0).sum() / count;
            gap_ = (problem_.gap + load_.displacement).array() - approach;
            residual = contact.select(gap_.abs(), -gap_).maxCoeff() / std::abs(approach);
            if (!std::isfinite(residual)) break;
            if (residual <= target) {
                if (residual <= finest_residual || problem_.is_2d()) // as the active set does
                    return;
                const double trusted = trusted_residual(problem_, approach, p, load_.displacement);
                if (residual <= trusted) return;
                target = std::max(finest_residual, std::min(0.5 * target, trusted));
            }
            ++iterations_;
            const double squares = contact.select(gap_.square(), 0).sum();
            const double growth = conjugate ? squares / previous : 0; // previous may be 0
            direction_.pressure = contact.select(gap_ + growth * direction_.pressure.array(), 0);
            previous = squares;
            solver_.update(direction_);
            ArrayXd image = direction_.displacement.array();
            if (load) image -= contact.select(image, 0).sum() / count;
            const double curvature = contact.select(image * direction_.pressure.array(), 0).sum();
            // A single node keeps its load whatever the step; those that join it take theirs.
            const double step = curvature > 0 && !(load && count == 1)
                                    ? contact.select(gap_ * direction_.pressure.array(), 0).sum() / curvature
                                    : 1 / problem_.column[0];
            p = contact.select(p.array() - step * direction_.pressure.array(), 0).max(0);
            const Eigen::Array<bool, Eigen::Dynamic, 1> overlap = p.array() == 0 && gap_ < 0;
            conjugate = !overlap.any();
            p = overlap.select(-step * gap_, p.array());
            if (load) p *= *load / p.sum();
        }
        expect_residual("Polonsky-Keer", problem_, {.residual = residual, .approach = approach}, target);
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    SetSolver solver_;
    SplitOperator check_;
    ContactSet set_;
    SurfaceState load_, direction_, tangent_;
    ArrayXd gap_;
    long iterations_ = 0;
};

} // namespace

void solve_polonsky_keer(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_steps<PolonskyKeer>(problem, options, solution);
}

} // namespace rough
