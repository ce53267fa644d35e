#include "domain/contact/spots.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/numerics/fourier.hpp"

#include <algorithm>

namespace rough {

Interface interface_at(const Profile& profile, const Body& given, const LoadStep& step,
                       const ContactState& state) {
    const Index nodes = profile.nodes();
    const double spacing = profile.spacing;
    const bool wraps = given.kernel == Kernel::periodic;
    const Body body = completed(given, profile_length(profile, given.kernel));
    auto influence = wraps ? FourierOperator::circulant(nodes, periodic_spectrum(nodes))
                           : FourierOperator::toeplitz(influence_column(
                                 body.kernel, nodes, body.datum / spacing, body.strip_width / spacing));
    Interface found;
    found.pressure = Eigen::VectorXd::Zero(nodes);
    for (std::size_t i = 0; i < state.nodes.size(); ++i)
        found.pressure[state.nodes[i]] = state.pressure[static_cast<Index>(i)];
    std::copy(found.pressure.begin(), found.pressure.end(), influence.input());
    const Eigen::Map<const Eigen::VectorXd> u(influence.apply(), nodes);
    found.gap = (u.array() * (spacing / body.effective_modulus) - step.displacement +
                 profile.heights.maxCoeff() - profile.heights.array());

    std::vector<bool> touches(static_cast<std::size_t>(nodes));
    for (const int node : state.nodes)
        touches[static_cast<std::size_t>(node)] = true;
    // A periodic body is gone round from a node off contact.
    const auto off = std::find(touches.begin(), touches.end(), false);
    if (wraps && off != touches.end())
        std::rotate(touches.begin(), off, touches.end());
    Index run = 0, widest = 0;
    for (const bool touch : touches) {
        found.spots += touch && run == 0;
        run = touch ? run + 1 : 0;
        widest = std::max(widest, run);
    }
    found.widest = spacing * static_cast<double>(widest);
    return found;
}

} // namespace rough
