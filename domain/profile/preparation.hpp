#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>

namespace rough {

/// The form to remove from a measured surface's heights. It is fitted to the heights at the nodes by least
/// squares. It is a polynomial of degree 0 to 4 or, for a profile, the arc of a circle. On a map the
/// polynomial has all terms in x and y up to its degree: `line` is a plane, `parabola` a quadratic form.
enum class Detrend { none, mean, line, parabola, cubic, quartic, arc };

/// The names of the forms, in the order of Detrend.
const std::vector<std::string>& detrend_names();
/// The name of a form.
const std::string& name_of(Detrend form);

/// The heights minus their form; unchanged for Detrend::none. Throws InputError if no arc fits, and on an arc
/// for a map.
Eigen::VectorXd detrended(const Profile& profile, Detrend form);

/// The heights without wavelengths shorter than the cut-off lambda (mm, > 0), by the Gaussian filter (ISO
/// 16610-21). Heights at the distance x have the weight exp(-pi (x/(alpha lambda))^2), alpha^2 = ln 2/pi, |x|
/// <= lambda. A cosine of wavelength l keeps 2^-(lambda/l)^2 of its amplitude, which is a half at l = lambda.
/// Roughness is the heights minus the filtered heights.
///
/// At the ends the window is cut off. There moments up to the first are kept (ISO 16610-28): the value is the
/// value of the weighted least-squares line. So a straight line does not change, and no length is lost. A map
/// is filtered along x and then along y. This is the areal Gaussian filter (ISO 16610-61), because its
/// weights are products. A plane does not change.
Eigen::VectorXd low_passed(const Profile& profile, double cut_off);

/// The indices of outliers of a measured profile, in increasing order. A node is an outlier if its height is
/// far outside the range that the seven nodes on each side predict. Each side predicts by its median (Hampel
/// 1974) and by its line of median slope (Theil 1950, Sen 1968). A wedge, a saw tooth, a step and a smooth
/// peak are predicted from at least one side.
///
/// The distance from the range must be more than six times the median difference between neighbours. This
/// must hold for the median over the whole profile and for the median over the 24 differences around the
/// node. The distance must also be more than three times the resolution of the heights.
///
/// Neighbours of an outlier are tested again without the outliers found so far. They are outliers, too, if
/// they are outside their range on the same side by half as much. So a particle is found whole, up to the
/// points at which its flanks return to the surface. Particles of up to four nodes are found. Much wider ones
/// count as surface. The first and the last three nodes are not tested, nor profiles of fewer than 16 nodes.
std::vector<Index> outliers(const Eigen::VectorXd& heights);

/// The heights after linear interpolation at these nodes (increasing) from their neighbours.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

} // namespace rough
