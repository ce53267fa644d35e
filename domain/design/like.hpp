#pragma once

#include "domain/accuracy/resolution.hpp"
#include "domain/problem/setup.hpp"

namespace rough {

/// What a design like a measured profile is asked for: the profile's own response under `own`, its model, in
/// these quantities, at `points` even pressures up to the set-up's max_pressure, or as far as it is loaded.
/// Fills in `like`, the targets, and the model on `nodes` nodes: 0 takes 512, or where area is asked for the
/// profile's own number, or so many that its contact begins with some of them, 512 to 2048. A map keeps its
/// own. The targets have the band of the resolution, unless it omits that.
DesignSetup like(DesignSetup setup, Profile profile, const Model& own, const std::string& name,
                 const std::vector<Quantity>& quantities = {Quantity::stiffness, Quantity::area_at_pressure},
                 Index points = 20, Index nodes = 0, Resolution resolution = Resolution::off);

/// What a scan may be asked for by name: both (stiffness and contact area), stiffness, area or
/// interface_stiffness.
const std::vector<std::string>& names_of_likeness();
/// The quantities of that name. Throws InputError on another word.
std::vector<Quantity> likeness_named(const std::string& name);

} // namespace rough
