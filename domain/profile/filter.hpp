#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// The Gaussian filter's long waves (ISO 16610-21): heights weighted by exp(-pi (x/(alpha lambda))^2),
/// alpha^2 = ln 2/pi, |x| <= lambda, so that a cosine of wave length l keeps 2^-(lambda/l)^2 of its
/// amplitude, a half at the cut-off lambda (mm, > 0). At the ends, where the window is cut off, moments up to
/// the first are kept (ISO 16610-28): the value of the weighted least-squares line, so that a line passes
/// unchanged and no length is lost. Roughness is the heights less this. An area is
/// filtered along x and along y, which is the areal Gaussian filter (ISO 16610-61), as its weights are a
/// product; a plane passes unchanged.
Eigen::VectorXd low_passed(const Profile& profile, double cut_off);

} // namespace rough
