#include "domain/contact/pressure_and_gap.hpp"

#include "domain/contact/solvers/problem.hpp"
#include "domain/contact/spots.hpp"

#include <algorithm>

namespace rough {

Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step,
                       const ContactState& state) {
    const ContactProblem problem = make_problem(surface, body, {});
    FourierOperator influence = fourier_operator(problem);
    Interface found;
    found.pressure = Eigen::VectorXd::Zero(surface.nodes());
    for (std::size_t i = 0; i < state.nodes.size(); ++i)
        found.pressure[state.nodes[i]] = state.pressure[static_cast<Index>(i)];
    std::copy(found.pressure.begin(), found.pressure.end(), influence.input());
    const Eigen::Map<const Eigen::VectorXd> u(influence.apply(), surface.nodes());
    found.gap = u.array() / problem.pressure_unit - step.displacement + problem.gap.array();

    const auto spots = contact_spots(state.nodes, problem.shape, body.kernel == Kernel::periodic);
    found.spots = static_cast<Index>(spots.size());
    if (!spots.empty())
        found.widest = static_cast<double>(spots.front()) * surface.spacing *
                       (surface.is_2d() ? surface.row_spacing : 1);
    return found;
}

} // namespace rough
