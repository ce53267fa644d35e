#include "domain/problem/setup.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/target/recorded.hpp"
#include "domain/target/similarity.hpp"

#include <algorithm>
#include <limits>

namespace rough {

namespace {

constexpr Index exactly_reported = 16385;
/// Up to so many nodes of the finer grid a factor takes a third of the time of the iterative solver at
/// reported_tolerance.
constexpr Index factored = 2049;
constexpr double reported_tolerance = 1e-10;
constexpr int area_ridges = 8;
/// A target's last pressure may be rounded.
constexpr double rounding = 1 + 1e-9;

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
        refuse_value("nodes", fewest, " given, expected 16 at least for a design");
    if (grid.is_2d() && setup.model.accuracy > 0)
        refuse_value("accuracy", setup.model.accuracy,
                     " given with an area, expected none: its bounds are of "
                     "profiles");
    if (grid.is_2d() && setup.model.body.kernel == Kernel::strip)
        refuse_value("kernel", "strip given with an area, expected free or periodic");
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
        refuse_value("shortest wave", shortest, " mm given, expected at least the distance of two nodes, ",
                     spacing, " mm: the grid sees no shorter wave");
    if (shortest > setup.bounds.lambda_to)
        refuse_value("shortest wave", shortest, " mm given, expected at most the longest wave, ",
                     setup.bounds.lambda_to, " mm");
    return setup;
}

void validate(const DesignSetup& setup) {
    if (setup.targets.empty())
        throw InputError("target: none given, expected at least one");
    if (setup.max_pressure && !(*setup.max_pressure > 0))
        refuse("max-pressure: ", *setup.max_pressure, " MPa given, expected more than 0");
    for (const Target& target : setup.targets) {
        validate(target);
        expect_recorded(target, setup.model);
        if (!(target.weight > 0) || target.weight > 1)
            refuse(target.name, ": weight ", target.weight, " given, expected more than 0, at most 1");
        if (setup.max_pressure && target.against_pressure() && target.last() > *setup.max_pressure * rounding)
            refuse(target.name, ": pressures up to ", target.last(),
                   " MPa given, expected at most max-pressure, ", *setup.max_pressure, " MPa");
        if (setup.max_pressure && !target.against_pressure())
            throw InputError(target.name +
                             ": a curve against displacement was given with max-pressure, expected "
                             "one of the two: Eq. 11 fixes no displacement");
    }
    for (const bool high : {false, true})
        if (setup.threshold && points_of_half(setup, high).empty())
            refuse("threshold: ", *setup.threshold, " leaves no point of the target ",
                   setup.targets.front().name, " in the ", high ? "high" : "low",
                   " part, expected one within its points");
}

std::vector<Index> points_of_half(const DesignSetup& setup, bool high) {
    const Target& target = setup.targets.front();
    const double threshold = setup.threshold.value_or(0.5 * target.last());
    return high ? points_within(target, threshold, std::numeric_limits<double>::infinity())
                : points_within(target, 0, threshold);
}

DesignSetup exactly(DesignSetup setup) {
    setup.model = exactly(std::move(setup.model));
    return setup;
}

DesignSetup as_reported(DesignSetup searched) {
    DesignSetup setup = exactly(std::move(searched));
    ContactOptions& contact = setup.model.contact;
    const Index nodes = refined(setup.model, 4).grid.nodes;
    if (!setup.model.grid.is_2d() && nodes <= exactly_reported)
        contact.tolerance = std::min(contact.tolerance, reported_tolerance);
    if (!setup.model.grid.is_2d() && nodes <= factored && contact.solver == Solver::automatic &&
        !setup.model.body.yields() && contact_sets_nest(setup.model.body, setup.model.grid))
        contact.solver = Solver::nested;
    return setup;
}

} // namespace rough
