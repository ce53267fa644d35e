#include "domain/contact/solvers/certificate.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/vector_loops.hpp"

#include <atomic>
#include <cmath>

namespace rough {

Certificate certify(const ContactProblem& problem, double approach, const std::vector<int>& contact,
                    const Eigen::VectorXd& pressure, const double* displacement) {
    const double scale = approach > 0 ? approach : 1, mean = pressure.sum() / problem.elements;
    constexpr double none = std::numeric_limits<double>::infinity();
    // Penetration is sought over all nodes: on the contact set it is part of |gap|.
    std::atomic<bool> finite = true;
    double deepest = problem.team->largest(problem.nodes(), [&](Index first, Index count) {
        bool all = true;
        const double depth =
            vector_loops().deepest(problem.gap.data() + first, displacement + first, count, approach, all);
        if (!all) finite = false;
        return depth;
    });
    if (!std::isfinite(mean) || !finite) // a NaN anywhere invalidates the solution
        return {none, none, none, none};
    const bool yields = std::isfinite(problem.cap);
    double misfit = 0;
    for (std::size_t k = 0; k < contact.size(); ++k) {
        const double gap = displacement[contact[k]] - (approach - problem.gap[contact[k]]);
        const bool held = yields && pressure[static_cast<Index>(k)] >= problem.cap;
        misfit = std::max(misfit, held ? gap : std::abs(gap));
    }
    if (yields) { // held nodes may sink in
        const Eigen::Map<const Eigen::VectorXd> u(displacement, problem.nodes());
        Eigen::ArrayXd depth = approach - (problem.gap + u).array();
        for (std::size_t k = 0; k < contact.size(); ++k)
            if (pressure[static_cast<Index>(k)] >= problem.cap) depth[contact[k]] = 0;
        deepest = depth.maxCoeff();
    }
    const double penetration = std::max(0.0, deepest);
    const auto over_mean = [mean](double excess) { return !(excess > 0) ? 0 : mean > 0 ? excess / mean : none; };
    const double lowest = pressure.size() ? pressure.minCoeff() : 0,
                 largest = pressure.size() ? pressure.maxCoeff() : 0;
    return {misfit / scale, penetration / scale, over_mean(-lowest), over_mean(largest - problem.cap)};
}

double direct_tolerance(const ContactProblem& problem, const StepSolution& step) {
    constexpr double usual = 1e-9, unit_roundoff = 0x1p-53;
    const double rows = 3 * static_cast<double>(step.pressure.size()) + 1, h0 = problem.column[0];
    return std::max(usual,
                    rows * unit_roundoff *
                        (h0 * step.pressure.cwiseAbs().sum() / step.approach + 2 * std::sqrt(h0 * step.stiffness)));
}

void expect_residual(const char* solver, const ContactProblem& problem, const StepSolution& step, double tolerance) {
    if (!(step.residual <= tolerance))
        throw NotConverged(line_of(solver, " did not converge at an approach of ",
                                   step.approach * problem.displacement_unit, " mm: residual ", step.residual,
                                   " is above the tolerance ", tolerance));
}

void certify_step(const char* solver, const ContactProblem& problem, StepSolution& step, SplitOperator& check,
                  const Eigen::VectorXd& pressure, double tolerance) {
    const Eigen::VectorXd displacement = check.apply(pressure);
    step.residual = certify(problem, step.approach, step.nodes, step.pressure, displacement.data()).residual();
    expect_residual(solver, problem, step, tolerance);
}

double trusted_residual(const ContactProblem& problem, double approach, const Eigen::VectorXd& pressure,
                        const Eigen::VectorXd& displacement) {
    double margin = approach;
    for (Index i = 0; i < problem.nodes(); ++i)
        margin =
            std::min(margin, pressure[i] > 0 ? pressure[i] / 3 : (displacement[i] - (approach - problem.gap[i])) / 1.5);
    return margin / approach;
}

} // namespace rough
