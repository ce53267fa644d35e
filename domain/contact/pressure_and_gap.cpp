#include "domain/contact/pressure_and_gap.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/contact/spots.hpp"
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

    const auto spots = contact_spots(state.nodes, {nodes, 1}, wraps);
    found.spots = static_cast<Index>(spots.size());
    found.widest = spots.empty() ? 0 : spacing * static_cast<double>(spots.front());
    return found;
}

} // namespace rough
