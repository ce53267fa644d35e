#pragma once

#include "domain/accuracy/resolution.hpp"
#include "domain/target/target.hpp"

#include <functional>

namespace rough {

/// y at `points` even points up to `last`, in the quantity's units.
Target even_target(Quantity quantity, const std::string& name, Index points, double last,
                   const std::function<double(double)>& y);

/// A profile's own response as a target, with what it was recorded under: at even points up to `last` (MPa or
/// mm; 0, or more than the load steps reach: up to their end). Of few load steps the points before the first
/// secant are left out if the curve, continued there, is not above 0. With a resolution, its band over the
/// heights as they are and interpolated (accuracy/resolution.hpp), unless that omits it. Throws InputError if
/// an interface stiffness is infinite there, in full contact.
Target target_like(const Profile& profile, const Model& model, const std::string& name,
                   Quantity quantity = Quantity::stiffness, Index points = 20, double last = 0,
                   Resolution resolution = Resolution::off);
/// The same of several quantities, whose curves are computed once.
std::vector<Target> targets_like(const Profile& profile, const Model& model, const std::string& name,
                                 const std::vector<Quantity>& quantities, Index points, double last,
                                 Resolution resolution);

} // namespace rough
