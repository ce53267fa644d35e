#pragma once

#include "domain/accuracy/resolution.hpp"
#include "domain/problem/setup.hpp"

namespace rough {

/// A design with the response of a measured profile as target. Sets `like`, the targets and the model. The
/// targets are the profile's response under its model. They have `points` even pressures up to the set-up's
/// max_pressure, or else up to the model's last load. They have the band of the resolution unless it is off.
/// The grid gets `nodes` nodes, or 512 if `nodes` is 0. For contact area, 0 stands for the profile's number
/// of nodes (512 to 2048). More are taken if fewer than 16 would touch at the first point. A map keeps its
/// nodes.
DesignSetup like(DesignSetup setup, Profile profile, const Model& model, const std::string& name,
                 const std::vector<Quantity>& quantities = {Quantity::stiffness, Quantity::area_at_pressure},
                 Index points = 20, Index nodes = 0, Resolution resolution = Resolution::off);

/// Names of the quantities of a scan: both (stiffness and contact area), stiffness, area or
/// interface_stiffness.
const std::vector<std::string>& names_of_likeness();
/// The quantities of that name. Throws InputError on another word.
std::vector<Quantity> likeness_named(const std::string& name);

} // namespace rough
