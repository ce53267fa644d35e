#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>

namespace rough {

/// What is taken off a measured profile's heights, by least squares over its even nodes.
enum class Detrend { none, mean, line, parabola };

/// "none", "mean", "line" or "parabola"; anything else throws InputError naming `where`.
Detrend detrend_named(std::string_view name, const std::string& where);

/// Heights (even nodes) less their least-squares mean, line or parabola; unchanged for Detrend::none.
Eigen::VectorXd detrended(const Eigen::VectorXd& heights, Detrend form);

} // namespace rough
