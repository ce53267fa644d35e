#include "domain/contact/pressure_and_gap.hpp"

#include "domain/contact/solvers/problem.hpp"

namespace rough {

std::vector<Index> contact_spots(const std::vector<int>& contact, Extent shape, bool periodic) {
    std::vector<char> waiting(static_cast<std::size_t>(shape.nodes()), 0);
    for (const int node : contact)
        waiting[static_cast<std::size_t>(node)] = 1;
    std::vector<Index> sizes, reached;
    const auto reach = [&](Index node) {
        if (std::exchange(waiting[static_cast<std::size_t>(node)], 0))
            reached.push_back(node);
    };
    for (const int first : contact) {
        reached.clear();
        reach(first);
        for (std::size_t k = 0; k < reached.size(); ++k)
            each_neighbour(reached[k], shape, periodic, reach);
        if (!reached.empty())
            sizes.push_back(static_cast<Index>(reached.size()));
    }
    std::sort(sizes.begin(), sizes.end(), std::greater<>());
    return sizes;
}

Interface interface_at(const Profile& surface, const Body& body, const LoadStep& step,
                       const ContactState& state) {
    const ContactProblem problem = make_problem(surface, body, {});
    FourierOperator influence = fourier_operator(problem);
    Interface found;
    found.pressure = Eigen::VectorXd::Zero(surface.nodes());
    found.pressure(state.nodes) = state.pressure;
    const Eigen::Map<const Eigen::VectorXd> u(influence.apply(state.nodes, state.pressure), surface.nodes());
    found.gap = u.array() / problem.pressure_unit - step.displacement + problem.gap.array();

    const auto spots = contact_spots(state.nodes, problem.shape, body.kernel == Kernel::periodic);
    found.spots = static_cast<Index>(spots.size());
    if (!spots.empty())
        found.widest = static_cast<double>(spots.front()) * surface.spacing *
                       (surface.is_2d() ? surface.row_spacing : 1);
    return found;
}

} // namespace rough
