#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// The form to remove from a measured surface's heights, by least squares of the heights over its evenly
/// spaced nodes. It is a polynomial of degree 0 to 4 or, for a profile, the arc of a circle. On a map the
/// polynomial has all terms in x and y up to its degree: `line` is a plane, `parabola` a quadratic form.
enum class Detrend { none, mean, line, parabola, cubic, quartic, arc };

/// The names of the forms, in the order of Detrend.
const std::vector<std::string>& detrend_names();
/// The name of a form.
const std::string& name_of(Detrend form);
/// The form of that name. Throws InputError with `where` on a name that is not in detrend_names().
Detrend detrend_named(std::string_view name, const std::string& where);

/// Heights minus their form; unchanged for Detrend::none. Throws InputError if no arc fits, and on an arc
/// for a map.
Eigen::VectorXd detrended(const Profile& profile, Detrend form);

} // namespace rough
