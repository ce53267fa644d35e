#pragma once

#include "domain/accuracy/resolution.hpp"
#include "domain/target/target.hpp"

#include <functional>

namespace rough {

/// A target with y(x) at `points` evenly spaced x up to `last`, in the quantity's units.
Target even_target(Quantity quantity, const std::string& name, Index points, double last,
                   const std::function<double(double)>& y);

/// A profile's response as a target, with its recorded model, at even points up to `last` (MPa or mm). If
/// `last` is 0 or beyond the end of the load steps, their end is used. With few load steps, points before the
/// first secant are omitted if the curve, continued there, is not above 0. With a resolution the target has
/// the band over the heights as they are and interpolated (accuracy/resolution.hpp), if that applies. Throws
/// InputError if an interface stiffness is infinite at full contact.
Target target_like(const Profile& profile, const Model& model, const std::string& name,
                   Quantity quantity = Quantity::stiffness, Index points = 20, double last = 0,
                   Resolution resolution = Resolution::off);
/// Targets of several quantities, as target_like; the response is computed once.
std::vector<Target> targets_like(const Profile& profile, const Model& model, const std::string& name,
                                 const std::vector<Quantity>& quantities, Index points, double last,
                                 Resolution resolution);

} // namespace rough
