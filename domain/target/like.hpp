#pragma once

#include "domain/response/model.hpp"
#include "domain/target/target.hpp"

#include <functional>

namespace rough {

/// y at `points` even points up to `last`, in the quantity's units.
Target even_target(Quantity quantity, const std::string& name, Index points, double last,
                   const std::function<double(double)>& y);

/// A profile's own response as a target, with what it was recorded under: at even points up to `last` (MPa or
/// mm; 0, or more than the load steps reach: up to their end). Of few load steps the points before the first
/// secant are left out if the curve, continued there, is not above 0. Throws InputError where an interface
/// stiffness is infinite there, in full contact.
Target target_like(const Profile& profile, const Model& model, const std::string& name,
                   Quantity quantity = Quantity::stiffness, Index points = 20, double last = 0);

} // namespace rough
