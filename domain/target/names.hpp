#pragma once

#include "domain/target/target.hpp"

namespace rough {

/// In the order of Quantity: stiffness, area, area-displacement, load, interface_stiffness.
const std::vector<std::string>& quantity_names();
/// One of them.
const std::string& name_of(Quantity quantity);
/// The quantity of that name. Throws InputError on another word.
Quantity quantity_named(const std::string& name);

} // namespace rough
