#include "domain/contact/set_solver.hpp"

#include "domain/contact/deflation.hpp"
#include "domain/contact/kernel.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Of the tangent, far beyond what it ever took.
constexpr long most_iterations = 5000;

/// Eigenvalues 1/S_k of the inverse of T. Chan's circulant, whose first column is ((M - j) h_j + j
/// h_(M-j))/M.
Eigen::VectorXd inverse_circulant(const ContactProblem& problem, Index length) {
    Eigen::VectorXd eigenvalues;
    if (problem.kernel == Kernel::periodic) {
        eigenvalues = periodic_spectrum(length);
    } else {
        const Eigen::VectorXd h =
            influence_column(problem.kernel, length, problem.datum, problem.strip_width);
        const FourierPlan plan = fourier_plan(length);
        AlignedBuffer<double> real(length);
        AlignedBuffer<fftw_complex> transform(length / 2 + 1);
        const double m = static_cast<double>(length);
        real[0] = h[0];
        for (Index j = 1; j < length; ++j) {
            const double share = static_cast<double>(j) / m;
            real[j] = (1 - share) * h[j] + share * h[length - j];
        }
        fftw_execute_dft_r2c(plan.forward, real.data(), transform.data());
        eigenvalues.resize(length / 2 + 1);
        for (Index k = 0; k < eigenvalues.size(); ++k)
            eigenvalues[k] = transform[k][0];
    }
    // A datum near its limit, or no datum at all, leaves the mean without a stiffness of its own.
    if (eigenvalues.size() > 1)
        eigenvalues[0] = std::max(eigenvalues[0], eigenvalues[1]);
    return eigenvalues.cwiseInverse();
}

Index circulant_length(const ContactProblem& problem) {
    return problem.kernel == Kernel::periodic ? problem.nodes() : fast_fourier_length(problem.nodes());
}

} // namespace

void ContactSet::collect() {
    nodes_.clear();
    for (std::size_t i = 0; i < touching_.size(); ++i)
        if (touching_[i])
            nodes_.push_back(static_cast<int>(i));
}

SetSolver::SetSolver(const ContactProblem& problem)
    : column_(problem.column), sums_(cumulative(problem.column)), forward_(fourier_operator(problem)),
      inverse_(FourierOperator::circulant(circulant_length(problem),
                                          inverse_circulant(problem, circulant_length(problem)))) {}

void SetSolver::load(Loaded& x) {
    const Index n = x.pressure.size();
    std::copy_n(x.pressure.data(), n, forward_.input());
    std::copy_n(forward_.apply(), n, x.displacement.data());
    ++applies_;
}

void SetSolver::precondition(const ContactSet& set, const Eigen::VectorXd& residual, Eigen::VectorXd& z) {
    double* full = inverse_.input();
    std::fill_n(full, inverse_.nodes(), 0.0);
    for (std::size_t k = 0; k < set.nodes().size(); ++k)
        full[set.nodes()[k]] = residual[static_cast<Index>(k)];
    const double* image = inverse_.apply();
    for (std::size_t k = 0; k < set.nodes().size(); ++k)
        z[static_cast<Index>(k)] = image[set.nodes()[k]];
}

bool SetSolver::improve(const ContactSet& set, const std::function<double(Index)>& target, Loaded& x,
                        const std::function<bool(double, double)>& enough, long most) {
    const auto& nodes = set.nodes();
    const Index m = static_cast<Index>(nodes.size()), n = x.pressure.size();
    if (m == 0)
        return true;
    Eigen::VectorXd r(m), z(m), q = Eigen::VectorXd::Zero(m), hq(m);
    for (Index k = 0; k < m; ++k) {
        const Index i = nodes[static_cast<std::size_t>(k)];
        r[k] = target(i) - x.displacement[i];
    }
    const Deflation deflation(nodes, column_, sums_);
    x.pressure(nodes) += deflation.project(r);
    double rz = 1;
    bool solved = false;
    for (long iteration = 0;; ++iteration) {
        precondition(set, r, z);
        const double energy = r.dot(z);
        solved = std::isfinite(energy) && enough(r.cwiseAbs().maxCoeff(), energy);
        if (solved || iteration == most || !(energy > 0))
            break;
        deflation.purge(z);
        q = z + (iteration == 0 ? 0.0 : energy / rz) * q;
        rz = energy;
        double* full = forward_.input();
        std::fill_n(full, n, 0.0);
        for (Index k = 0; k < m; ++k)
            full[nodes[static_cast<std::size_t>(k)]] = q[k];
        const double* image = forward_.apply();
        ++applies_;
        for (Index k = 0; k < m; ++k)
            hq[k] = image[nodes[static_cast<std::size_t>(k)]];
        const double curvature = q.dot(hq);
        if (!(curvature > 0))
            break;
        const double step = rz / curvature;
        r -= step * hq;
        x.pressure(nodes) += step * q;
    }
    for (Index k = 0; k < m; ++k) {
        const Index i = nodes[static_cast<std::size_t>(k)];
        x.displacement[i] = target(i) - r[k];
    }
    return solved;
}

void SetSolver::tangent(const ContactSet& set, double tolerance, bool each_entry, Loaded& w) {
    for (Index i = 0; i < w.pressure.size(); ++i)
        if (!set.holds(i))
            w.pressure[i] = 0;
    load(w);
    improve(
        set, [](Index) { return 1.0; }, w,
        [&](double largest, double energy) {
            return each_entry ? largest <= 0.1 * tolerance : energy <= 0.5 * tolerance * w.pressure.sum();
        },
        most_iterations);
}

double load_error(const ContactProblem& problem, double approach, const ContactSet& set, const Loaded& load,
                  const Loaded& tangent) {
    double error = 0;
    for (const int i : set.nodes())
        error += tangent.pressure[i] * (approach - problem.gap[i] - load.displacement[i]);
    return std::abs(error) / load.pressure.sum();
}

StepSolution step_solution(const ContactSet& set, const Loaded& load, const Loaded& tangent,
                           bool with_tangent) {
    StepSolution step;
    step.nodes = set.nodes();
    step.pressure = load.pressure(step.nodes);
    for (const int i : step.nodes)
        step.stiffness += tangent.pressure[i] * (2 - tangent.displacement[i]);
    if (with_tangent)
        step.tangent = tangent.pressure(step.nodes);
    return step;
}

} // namespace rough
