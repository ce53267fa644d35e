#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>

namespace rough {

/// The form to remove from a measured surface's heights, by least squares of the heights over its evenly
/// spaced nodes. It is a polynomial of degree 0 to 4 or, for a profile, the arc of a circle. On a map the
/// polynomial has all terms in x and y up to its degree: `line` is a plane, `parabola` a quadratic form.
enum class Detrend { none, mean, line, parabola, cubic, quartic, arc };

/// The names of the forms, in the order of Detrend.
const std::vector<std::string>& detrend_names();
/// The name of a form.
const std::string& name_of(Detrend form);

/// Heights minus their form; unchanged for Detrend::none. Throws InputError if no arc fits, and on an arc
/// for a map.
Eigen::VectorXd detrended(const Profile& profile, Detrend form);

/// The heights' long waves by the Gaussian filter (ISO 16610-21): heights weighted by exp(-pi (x/(alpha
/// lambda))^2), alpha^2 = ln 2/pi, |x| <= lambda. A cosine of wavelength l keeps 2^-(lambda/l)^2 of its
/// amplitude, a half at the cut-off lambda (mm, > 0). Roughness is the heights minus these.
///
/// The window is cut off at the ends. There moments up to the first are kept (ISO 16610-28): the value is
/// that of the weighted least-squares line. So a line passes unchanged and no length is lost. A map is
/// filtered along x and along y. That is the areal Gaussian filter (ISO 16610-61), because its weights are a
/// product; a plane passes unchanged.
Eigen::VectorXd low_passed(const Profile& profile, double cut_off);

/// Outlying nodes of a measured profile, in order. A node is an outlier if its height is outside the range
/// that the seven nodes on each side predict. Each side predicts by its median (Hampel 1974) and by its line
/// of median slope (Theil 1950, Sen 1968). The distance from the range must be more than six times the median
/// difference between neighbours. This holds for the median over the whole profile and for that over the 24
/// differences around the node. The distance must also be more than three times the resolution of the
/// heights. A wedge, a saw tooth, a step and a smooth peak are predicted from at least one side.
///
/// Neighbours of an outlier are tested again without the outliers found so far. They belong to it if they
/// stand out on the same side by half as much. So a particle is found whole, up to where its flanks return
/// to the surface. Particles of up to four nodes are found; much wider ones count as surface. The first
/// and the last three nodes are not tested, nor profiles of fewer than 16 nodes.
std::vector<Index> outliers(const Eigen::VectorXd& heights);

/// The heights, with those of these nodes (increasing) replaced linearly between their neighbours.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

} // namespace rough
