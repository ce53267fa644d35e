#pragma once

#include "domain/profile/profile.hpp"

#include <string>

namespace rough {

/// The form to remove from a measured surface's heights. It is fitted to the heights at the nodes by least
/// squares. It is a polynomial of degree 0 to 4 or, for a profile, the arc of a circle. On a map the
/// polynomial has all terms in x and y up to its degree: `line` is a plane, `parabola` a quadratic form.
enum class Detrend { none, mean, line, parabola, cubic, quartic, arc };

/// The names of the forms, in the order of Detrend.
const std::vector<std::string>& detrend_names();
/// The name of a form.
const std::string& name_of(Detrend form);

/// The heights minus their form, if any. Throws InputError if no arc fits, or on an arc for a map.
Eigen::VectorXd detrended(const Profile& profile, Detrend form);

/// The heights without wavelengths shorter than the cut-off lambda (mm, > 0), by the Gaussian filter (ISO
/// 16610-21). Heights at the distance x have the weight exp(-pi (x/(alpha lambda))^2), alpha^2 = ln 2/pi, |x|
/// <= lambda. A cosine of wavelength l keeps 2^-(lambda/l)^2 of its amplitude, which is a half at l = lambda.
/// Roughness is the heights minus the filtered heights.
///
/// Near the ends, the value is that of the weighted least-squares line through the nodes within lambda (ISO
/// 16610-28, moments up to the first). So a line or a plane does not change, and no length is lost. A map is
/// filtered along x and then along y: the areal Gaussian filter (ISO 16610-61).
Eigen::VectorXd low_passed(const Profile& profile, double cut_off);

/// The heights, with those at `nodes` (increasing) interpolated linearly from the nearest other nodes.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

/// Share of filled points above which a result is doubtful.
constexpr double doubtful_fill = 0.05;

/// The points of a surface that have no height.
struct MissingPoints {
    std::vector<Index> nodes = {}; ///< indices, increasing
    double share = 0;              ///< their number divided by that of all points, 0 to 1
    /// Size of the largest hole, which is connected along x or y: mm on a line, mm^2 on a map.
    double largest_hole = 0;

    explicit operator bool() const { return !nodes.empty(); } ///< whether there is one
};
/// The points whose height is NaN.
MissingPoints missing_points(const Profile& surface);

/// The surface with heights at its missing points. A line is linear between the nearest measured points. On a
/// map the least-squares plane of the measured heights is removed. The difference is continued by Laplace's
/// equation: a filled height is the weighted mean of its neighbours. Throws as expect_fillable().
Profile filled(Profile surface, const MissingPoints& missing, double max_share = 1);

/// The surface with the heights at `nodes` replaced as those of missing points.
Profile without(Profile surface, const std::vector<Index>& nodes);

/// Throws InputError, beginning with `where`, if all points are missing or a share above `max_share`.
void expect_fillable(const MissingPoints& missing, double max_share, bool is_2d, const std::string& where = "surface");

/// "12 missing points (1.2 %), largest hole 0.5 mm²", on a line in mm.
std::string in_words(const MissingPoints& missing, bool is_2d);

} // namespace rough
