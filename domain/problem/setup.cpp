#include "domain/problem/setup.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

constexpr Index max_exactly_reported = 16385; ///< nodes of the finer grid
/// Nodes up to which a factor takes a third of the time of the iterative solver at reported_tolerance.
constexpr Index max_factored = 2049;
constexpr double reported_tolerance = 1e-10;
constexpr Index min_coarse_nodes = 32;      ///< along either side of a coarser grid
constexpr double min_coarse_spacings = 1.9; ///< node spacings of a coarser grid per shortest wavelength
constexpr double rounded_up = 1 + 1e-9;     ///< a target's last pressure may be rounded

/// Minimum number of nodes in contact at a target's first point, because contact fractions are counts.
constexpr double first_nodes = 32;
constexpr double min_area_nodes = 512, max_area_nodes = 4096; ///< limits of the default for contact area
/// Largest distance of a band's edges from the measured curve, relative to this curve.
constexpr double max_band_share = 0.05;

Index enough_nodes(const Profile& profile, const std::vector<Target>& targets) {
    double nodes = 0;
    for (const Target& target : targets)
        if (is_contact_fraction(target.quantity))
            nodes = std::max({nodes, static_cast<double>(profile.nodes()), first_nodes / target.y[0]});
    return nodes == 0 ? Grid().nodes : static_cast<Index>(std::clamp(nodes, min_area_nodes, max_area_nodes));
}

} // namespace

void validate(const DesignSetup& setup) {
    const Grid& grid = setup.model.grid;
    const Index fewest = grid.is_2d() ? std::min(grid.nodes, grid.rows) : grid.nodes;
    if (!setup.phases && fewest < 16) refuse_value("nodes", fewest, " are too few for a design; give at least 16");
    if (setup.model.accuracy > 0)
        refuse_value("accuracy", setup.model.accuracy, " does not apply to a design; omit it");
    if (grid.is_2d() && setup.model.body.kernel == Kernel::strip)
        refuse_value("kernel", "strip does not apply to a map; give free or periodic");
    validate(setup.model);
    const double shortest = setup.limits.shortest_wave, spacing = grid.widest_spacing();
    if (!setup.phases && shortest < spacing)
        refuse_value("shortest wave", shortest, " mm is below the node spacing; give at least ", spacing, " mm");
    if (!setup.phases && shortest > setup.bounds.lambda_to)
        refuse_value("shortest wave", shortest, " mm is above the longest wave; give at most ", setup.bounds.lambda_to,
                     " mm");
    if (setup.errors.noise > 0 && !(setup.errors.noise_length > 0))
        refuse_value("noise-length", setup.errors.noise_length, " mm is not above 0; give a length");
    if (setup.targets.empty()) throw InputError("target: none given; give at least one");
    if (setup.max_pressure && !(*setup.max_pressure > 0))
        refuse("max-pressure: ", *setup.max_pressure, " MPa is not above 0; give a pressure");
    for (const Target& target : setup.targets) {
        validate(target);
        expect_recorded(target, setup.model);
        if (!(target.weight > 0) || target.weight > 1)
            refuse(target.name, ": weight ", target.weight, " is out of range (above 0, at most 1)");
        if (setup.max_pressure && target.against_pressure() && target.last() > *setup.max_pressure * rounded_up)
            refuse(target.name, ": its pressures up to ", target.last(), " MPa exceed max-pressure, ",
                   *setup.max_pressure, " MPa; raise max-pressure");
        if (setup.max_pressure && !target.against_pressure())
            refuse(target.name, ": is a curve against displacement, which Eq. 11 does not fix; omit max-pressure");
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
        if (high ? target.x[k] >= threshold : target.x[k] <= threshold) points.push_back(k);
    return points;
}

DesignSetup on_coarser_grid(DesignSetup setup, int halvings) {
    for (int i = 0; i < halvings; ++i) {
        Grid grid = setup.model.grid;
        grid.nodes /= 2;
        if (grid.is_2d()) grid.rows /= 2;
        if (std::min(grid.nodes, grid.is_2d() ? grid.rows : grid.nodes) < min_coarse_nodes ||
            setup.limits.shortest_wave < min_coarse_spacings * grid.widest_spacing())
            break;
        setup.model.grid = grid;
    }
    return setup;
}

DesignSetup as_reported(DesignSetup setup) {
    ContactOptions& contact = setup.model.contact;
    const Index nodes = refined(setup.model, 4).grid.nodes;
    if (!setup.model.grid.is_2d() && nodes <= max_exactly_reported)
        contact.tolerance = std::min(contact.tolerance, reported_tolerance);
    if (!setup.model.grid.is_2d() && nodes <= max_factored && contact.solver == Solver::automatic &&
        !setup.model.body.yields() && contact_sets_nest(setup.model.body, setup.model.grid))
        contact.solver = Solver::nested;
    return setup;
}

DesignSetup design_like(const Profile& profile, Model model, const std::string& name,
                        const std::vector<Quantity>& quantities, Index points, std::optional<Extent> nodes,
                        Resolution resolution, std::optional<double> max_pressure) {
    auto targets = targets_like(profile, model, name, quantities, {points, max_pressure}, resolution);
    for (Target& target : targets)
        if (target.has_band()) {
            target.lower = target.lower.cwiseMax((1 - max_band_share) * target.y);
            target.upper = target.upper.cwiseMin((1 + max_band_share) * target.y);
        }
    const Extent usual = profile.is_2d() ? profile.shape() : Extent{enough_nodes(profile, targets)};
    model.grid.nodes = nodes.value_or(usual).columns;
    model.grid.rows = nodes.value_or(usual).rows;
    return {
        .model = std::move(model), .targets = std::move(targets), .max_pressure = max_pressure, .measured = profile};
}

const std::vector<std::string>& names_of_likeness() {
    static const std::vector<std::string> names{"both", "stiffness", "area", "interface_stiffness"};
    return names;
}

std::vector<Quantity> likeness_named(const std::string& name) {
    if (name == "both") return {Quantity::stiffness, Quantity::area_at_pressure};
    if (std::ranges::count(names_of_likeness(), name) == 0)
        refuse_value("quantity", "'", name, "' is unknown; use both, stiffness, area or interface_stiffness");
    return {quantity_named(name)};
}

} // namespace rough
