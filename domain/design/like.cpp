#include "domain/design/like.hpp"

#include "domain/errors.hpp"
#include "domain/target/like.hpp"
#include "domain/target/target.hpp"

#include <algorithm>

namespace rough {

namespace {

/// Minimum number of nodes in contact at a target's first point, because contact fractions are counts.
constexpr double first_nodes = 16;

Index enough_nodes(const DesignSetup& setup) {
    double nodes = 0;
    for (const Target& target : setup.targets)
        if (is_contact_fraction(target.quantity))
            nodes = std::max({nodes, static_cast<double>(setup.like->nodes()), first_nodes / target.y[0]});
    return nodes == 0 ? Grid().nodes : static_cast<Index>(std::clamp(nodes, 512., 2048.));
}

} // namespace

DesignSetup like(DesignSetup setup, Profile profile, const Model& model, const std::string& name,
                 const std::vector<Quantity>& quantities, Index points, Index nodes, Resolution resolution) {
    setup.like = std::move(profile);
    setup.model = model;
    setup.targets = targets_like(*setup.like, model, name, quantities, points, setup.max_pressure.value_or(0),
                                 resolution);
    if (!setup.like->is_2d())
        setup.model.grid.nodes = nodes > 0 ? nodes : enough_nodes(setup);
    return setup;
}

const std::vector<std::string>& names_of_likeness() {
    static const std::vector<std::string> names{"both", "stiffness", "area", "interface_stiffness"};
    return names;
}

std::vector<Quantity> likeness_named(const std::string& name) {
    if (name == "both")
        return {Quantity::stiffness, Quantity::area_at_pressure};
    if (std::ranges::count(names_of_likeness(), name) == 0)
        refuse_value("quantity", "'", name, "' is unknown; use both, stiffness, area or interface_stiffness");
    return {quantity_named(name)};
}

} // namespace rough
