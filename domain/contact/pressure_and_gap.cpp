#include "domain/contact/pressure_and_gap.hpp"

#include "domain/contact/solvers/problem.hpp"

#include <algorithm>
#include <functional>

namespace rough {

std::vector<Index> contact_spots(const std::vector<int>& contact, Extent shape, bool periodic) {
    std::vector<char> waiting(static_cast<std::size_t>(shape.nodes()), 0);
    for (const int node : contact)
        waiting[static_cast<std::size_t>(node)] = 1;
    std::vector<Index> sizes, reached;
    const auto reach = [&](Index i, Index j) {
        if (periodic) {
            i = (i + shape.columns) % shape.columns;
            j = (j + shape.rows) % shape.rows;
        }
        if (i < 0 || j < 0 || i >= shape.columns || j >= shape.rows)
            return;
        const Index node = j * shape.columns + i;
        if (!waiting[static_cast<std::size_t>(node)])
            return;
        waiting[static_cast<std::size_t>(node)] = 0;
        reached.push_back(node);
    };
    for (const int first : contact) {
        reached.clear();
        reach(first % shape.columns, first / shape.columns);
        for (std::size_t k = 0; k < reached.size(); ++k) {
            const Index i = reached[k] % shape.columns, j = reached[k] / shape.columns;
            reach(i - 1, j);
            reach(i + 1, j);
            reach(i, j - 1);
            reach(i, j + 1);
        }
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
