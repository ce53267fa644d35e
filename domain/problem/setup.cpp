#include "domain/problem/setup.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"

namespace rough {

namespace {

constexpr Index max_exactly_reported = 16385; ///< nodes of the finer grid
/// Nodes of the finer grid up to which a factor takes a third of the time of the iterative solver at
/// reported_tolerance.
constexpr Index max_factored = 2049;
constexpr double reported_tolerance = 1e-10;
constexpr int area_ridges = 8;
/// A target's last pressure may be rounded.
constexpr double rounded_up = 1 + 1e-9;

/// Minimum number of nodes in contact at a target's first point, because contact fractions are counts.
constexpr double first_nodes = 32;
/// Range of the default number of nodes for contact area.
constexpr double min_area_nodes = 512, max_area_nodes = 4096;
/// Largest distance of a band's edges from the measured curve, relative to this curve.
constexpr double max_band_share = 0.05;

Index enough_nodes(const DesignSetup& setup) {
    double nodes = 0;
    for (const Target& target : setup.targets)
        if (is_contact_fraction(target.quantity))
            nodes = std::max({nodes, static_cast<double>(setup.like->nodes()), first_nodes / target.y[0]});
    return nodes == 0 ? Grid().nodes : static_cast<Index>(std::clamp(nodes, min_area_nodes, max_area_nodes));
}

} // namespace

GeneBounds completed(GeneBounds bounds, double length) {
    if (bounds.lambda_from == 0)
        bounds.lambda_from = 0.25 * length;
    if (bounds.lambda_to == 0)
        bounds.lambda_to = 4 * length;
    return bounds;
}

DesignSetup completed(DesignSetup setup) {
    setup.model = completed(setup.model);
    const Grid& grid = setup.model.grid;
    const Index fewest = grid.is_2d() ? std::min(grid.nodes, grid.rows) : grid.nodes;
    if (!setup.phases && fewest < 16)
        refuse_value("nodes", fewest, " are too few for a design; give at least 16");
    if (grid.is_2d() && setup.model.accuracy > 0)
        refuse_value("accuracy", setup.model.accuracy, " does not apply to a map; omit it");
    if (grid.is_2d() && setup.model.body.kernel == Kernel::strip)
        refuse_value("kernel", "strip does not apply to a map; give free or periodic");
    validate(setup.model);
    if (setup.errors.noise_length == 0)
        setup.errors.noise_length = grid.length / 60;
    if (setup.ridges == 0)
        setup.ridges = grid.is_2d() ? area_ridges : 1;
    if (setup.phases)
        return setup;
    setup.bounds = completed(setup.bounds, grid.length);
    double& shortest = setup.limits.shortest_wave;
    const double spacing = grid.widest_spacing();
    if (shortest == 0)
        shortest = 8 * spacing;
    if (shortest < spacing)
        refuse_value("shortest wave", shortest, " mm is below the node spacing; give at least ", spacing,
                     " mm");
    if (shortest > setup.bounds.lambda_to)
        refuse_value("shortest wave", shortest, " mm is above the longest wave; give at most ",
                     setup.bounds.lambda_to, " mm");
    return setup;
}

void validate(const DesignSetup& setup) {
    if (setup.targets.empty())
        throw InputError("target: none given; give at least one");
    if (setup.max_pressure && !(*setup.max_pressure > 0))
        refuse("max-pressure: ", *setup.max_pressure, " MPa is not above 0; give a pressure");
    for (const Target& target : setup.targets) {
        validate(target);
        expect_recorded(target, setup.model);
        if (!(target.weight > 0) || target.weight > 1)
            refuse(target.name, ": weight ", target.weight, " is out of range (above 0, at most 1)");
        if (setup.max_pressure && target.against_pressure() &&
            target.last() > *setup.max_pressure * rounded_up)
            refuse(target.name, ": its pressures up to ", target.last(), " MPa exceed max-pressure, ",
                   *setup.max_pressure, " MPa; raise max-pressure");
        if (setup.max_pressure && !target.against_pressure())
            throw InputError(target.name +
                             ": is a curve against displacement, which Eq. 11 does not fix; omit "
                             "max-pressure");
    }
    for (const bool high : {false, true})
        if (setup.threshold && points_of_half(setup, high).empty())
            refuse("threshold: ", *setup.threshold, " lies ", high ? "above" : "below", " all points of ",
                   setup.targets.front().name, "; give one between them");
}

std::vector<Index> points_of_half(const DesignSetup& setup, bool high) {
    const Target& target = setup.targets.front();
    const double threshold = setup.threshold.value_or(0.5 * target.last());
    std::vector<Index> points;
    for (Index k = 0; k < target.points(); ++k)
        if (high ? target.x[k] >= threshold : target.x[k] <= threshold)
            points.push_back(k);
    return points;
}

DesignSetup exactly(DesignSetup setup) {
    setup.model = exactly(std::move(setup.model));
    return setup;
}

DesignSetup as_reported(DesignSetup searched) {
    DesignSetup setup = exactly(std::move(searched));
    ContactOptions& contact = setup.model.contact;
    const Index nodes = refined(setup.model, 4).grid.nodes;
    if (!setup.model.grid.is_2d() && nodes <= max_exactly_reported)
        contact.tolerance = std::min(contact.tolerance, reported_tolerance);
    if (!setup.model.grid.is_2d() && nodes <= max_factored && contact.solver == Solver::automatic &&
        !setup.model.body.yields() && contact_sets_nest(setup.model.body, setup.model.grid))
        contact.solver = Solver::nested;
    return setup;
}

DesignSetup like(DesignSetup setup, Profile profile, const Model& model, const std::string& name,
                 const std::vector<Quantity>& quantities, Index points, Index nodes, Resolution resolution) {
    setup.like = std::move(profile);
    setup.model = model;
    setup.targets = targets_like(*setup.like, model, name, quantities, points, setup.max_pressure.value_or(0),
                                 resolution);
    for (Target& target : setup.targets)
        if (target.has_band()) {
            target.lower = target.lower.cwiseMax((1 - max_band_share) * target.y);
            target.upper = target.upper.cwiseMin((1 + max_band_share) * target.y);
        }
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
