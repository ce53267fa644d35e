#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// What is taken off a measured surface's heights as its form, by least squares of the ordinates over its
/// even nodes: polynomials of degree 0 to 4 (of an area in x and y, all terms up to that degree: `line` is
/// its plane, `parabola` its quadratic form), or of a profile the arc of a circle.
enum class Detrend { none, mean, line, parabola, cubic, quartic, arc };

/// The words for them, in their order.
const std::vector<std::string>& detrend_names();
/// The word for one.
const std::string& name_of(Detrend form);
/// One of detrend_names(); anything else throws InputError naming `where`.
Detrend detrend_named(std::string_view name, const std::string& where);

/// Heights less their form; unchanged for Detrend::none. Throws InputError where no arc fits, and on an
/// arc of an area.
Eigen::VectorXd detrended(const Profile& profile, Detrend form);

} // namespace rough
