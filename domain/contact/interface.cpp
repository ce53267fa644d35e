#include "domain/contact/interface.hpp"

#include "domain/contact/solvers/set_solver.hpp"
#include "domain/numerics/statistics.hpp"

#include <cmath>

namespace rough {

Index spot_width(const std::vector<int>& contact, Extent shape, bool periodic) {
    std::vector<Index> sizes = group_sizes(contact, shape, periodic);
    std::size_t below = 0;
    while (!sizes.empty() && 2 * (below += static_cast<std::size_t>(sizes.back())) < contact.size()) sizes.pop_back();
    const double nodes = sizes.empty() ? 0 : static_cast<double>(sizes.back());
    return std::lround(shape.rows > 1 ? std::sqrt(nodes) : nodes);
}

Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step, const ContactState& state) {
    const ContactProblem problem = make_problem(surface, body, {});
    FourierOperator influence = fourier_operator(problem);
    Interface found;
    found.pressure = Eigen::VectorXd::Zero(surface.nodes());
    found.pressure(state.nodes) = state.pressure;
    const Eigen::Map<const Eigen::VectorXd> u(influence.apply(state.nodes, state.pressure), surface.nodes());
    found.gap = u.array() / problem.pressure_unit - step.displacement + problem.gap.array();

    const auto spots = group_sizes(state.nodes, problem.shape, body.kernel == Kernel::periodic);
    found.spots = static_cast<Index>(spots.size());
    if (!spots.empty())
        found.widest =
            static_cast<double>(spots.front()) * surface.spacing * (surface.is_2d() ? surface.row_spacing : 1);
    return found;
}

SmoothArea smooth_area(const Profile& profile, const Body& body, const ContactCurve& curve, bool with_derivatives) {
    constexpr double tolerance = 1e-9; // residual of the adjoint's solutions over the right-hand side
    constexpr long max_iterations = 500;
    // Keeps an edge's rate finite if both of its nodes are at the edge of contact; a share of the displacement.
    constexpr double closest = 1e-9;
    const ContactProblem problem = make_problem(profile, body, column(curve.steps, &LoadStep::displacement));
    const Index n = problem.nodes(), steps = static_cast<Index>(curve.steps.size());
    const double tangent_unit = problem.pressure_unit / problem.displacement_unit;
    const double per_mm = 1 / (static_cast<double>(n) * problem.displacement_unit);
    SetSolver solver(problem);
    // The four edges of a map's node count half each, so that the sum is continuous when a node enters.
    const double share = problem.shape.rows > 1 ? 0.5 : 1;
    Index highest = 0;
    profile.heights.maxCoeff(&highest);
    SmoothArea area{Eigen::VectorXd(steps), Eigen::VectorXd::Zero(steps), Eigen::MatrixXd::Zero(steps, n)};
    for (Index j = 0; j < steps; ++j) {
        const ContactState& state = curve.states[static_cast<std::size_t>(j)];
        const double approach = problem.approach[static_cast<std::size_t>(j)];
        SurfaceState p(n), w(n), off(n), z(n);
        ContactSet set(n);
        p.pressure(state.nodes) = state.pressure / problem.pressure_unit;
        w.pressure(state.nodes) = state.tangent / tangent_unit;
        for (const int node : state.nodes) set.insert(node);
        set.collect();
        solver.update(p);
        solver.update(w);
        double count = static_cast<double>(state.nodes.size()), rate = 0;
        Eigen::VectorXd on = Eigen::VectorXd::Zero(n); // d/dp_i; off: d/dgap_k
        const auto add_edge = [&](Index i, Index k) {  // i touches, k is a neighbour
            if (set.holds(k)) return;
            const double closing = std::max(closest, 1 - w.displacement[k]);
            const double since = p.pressure[i] / w.pressure[i] + closest * approach;
            const double until =
                std::max(0.0, p.displacement[k] - approach + problem.gap[k]) / closing + closest * approach;
            const double both = since + until;
            count += share * (since / both - 0.5);
            rate += share / both;
            on[i] += share * (until / (both * both) / w.pressure[i]);
            off.pressure[k] -= share * (since / (both * both) / closing);
        };
        for (const int i : state.nodes)
            each_neighbour(i, problem.shape, problem.kernel == Kernel::periodic, [&](Index k) { add_edge(i, k); });
        area.fraction[j] = count / static_cast<double>(n);
        if (!with_derivatives) continue;
        // dp_A = w s + H_AA^-1 dZ_A, dgap_k = H_kA dp_A - s - dZ_k with s = dDelta - dZ_max.
        solver.update(off);
        const Eigen::VectorXd right = on + off.displacement;
        double largest = 0;
        for (const int i : set.nodes()) largest = std::max(largest, std::abs(right[i]));
        solver.improve(
            set, [&](Index i) { return right[i]; }, z, Enough{tolerance * largest}, max_iterations);
        area.by_displacement[j] = rate * per_mm;
        area.by_height.row(j) = per_mm * (z.pressure - off.pressure).transpose();
        area.by_height(j, highest) -= rate * per_mm;
    }
    return area;
}

} // namespace rough
