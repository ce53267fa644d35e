#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// The heights' long waves by the Gaussian filter (ISO 16610-21): heights weighted by exp(-pi (x/(alpha
/// lambda))^2), alpha^2 = ln 2/pi, |x| <= lambda. A cosine of wavelength l keeps 2^-(lambda/l)^2 of its
/// amplitude, a half at the cut-off lambda (mm, > 0). Roughness is the heights minus these.
///
/// The window is cut off at the ends. There moments up to the first are kept (ISO 16610-28): the value is
/// that of the weighted least-squares line. So a line passes unchanged and no length is lost. A map is
/// filtered along x and along y. That is the areal Gaussian filter (ISO 16610-61), because its weights are a
/// product; a plane passes unchanged.
Eigen::VectorXd low_passed(const Profile& profile, double cut_off);

} // namespace rough
