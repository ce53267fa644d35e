#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>

/// @file
/// Parameters of profiles (ISO 21920-2:2021, ISO 4287) and of areal maps (ISO 25178-2:2021). Integrals are
/// means over the nodes.
namespace rough {

/// First and second derivatives of a surface by the seven-point formulas of ISO 21920-2 (exact for
/// polynomials up to degree 6), columns x rows. They are given at nodes three or more from every end, and at
/// all nodes of a periodic surface. A line has only those along x.
struct Derivatives {
    Eigen::ArrayXXd x;  ///< dz/dx
    Eigen::ArrayXXd y;  ///< dz/dy; empty for a line
    Eigen::ArrayXXd xx; ///< d2z/dx2, 1/mm
    Eigen::ArrayXXd yy; ///< d2z/dy2, 1/mm; empty for a line
};
/// Throws InputError on fewer than seven nodes along x or y.
Derivatives derivatives(const Profile& surface, bool periodic = false);

/// One parameter of a surface.
struct SurfaceParameter {
    std::string name;    ///< "Ra", "Sdq"
    std::string unit;    ///< "mm", "1/mm", "mm²", "1/mm²", "°" or ""
    std::string meaning; ///< in a few words
    double value = 0;    ///< in its unit; NaN if the surface has none

    /// Name and unit as a key of JSON: "Ra_mm", "m4_per_mm2", "Std_degrees".
    std::string key() const;
};

/// The parameters of a surface, in the order of the standard.
struct SurfaceParameters {
    std::vector<SurfaceParameter> rows; ///< one per parameter

    /// The row of that name. Throws InputError if it does not exist.
    const SurfaceParameter& row(std::string_view name) const;
    /// The value of that name. Throws InputError if it does not exist.
    double operator[](std::string_view name) const { return row(name).value; }
};

/// Parameters of a sampled profile about its mean line. They are Ra, Rq, Rsk, Rku, Rp, Rv, Rz, Rt, Rc, RSm,
/// Rdq, Rmr, Rk, Rpk, Rvk, Rmrk1, Rmrk2. If the whole profile is one section, P replaces R, because no
/// wavelengths over lambda_c were removed. Slopes and curvatures are by the seven-point formula.
///
/// Then follow the rms curvature and the spectral moments m0, m2 and m4 (mean squares of height, slope and
/// second derivative; Nayak 1971). The last is the bandwidth alpha = m0 m4/m2^2, at least 1.
struct Roughness : SurfaceParameters {
    double section_length = 0; ///< mm
    Index sections = 1;        ///< whole section lengths, which together are the evaluation length
};
/// Evaluates as many whole section lengths as the profile has, in its middle. `section_length` in mm
/// (lambda_c of a roughness profile); 0: the whole profile is one section. Throws InputError on fewer than
/// ten nodes, fewer than two per section, a section longer than the profile, or a constant profile.
Roughness roughness(const Profile& profile, double section_length = 0);

/// Rmr(c): the share of the length on which the profile, straight between its nodes, is higher than `level`
/// (mm, from the zero of the heights). For a map, Smr(c): the share of its nodes.
double material_ratio(const Profile& profile, double level);

/// Smc(mr) of a map (ISO 25178-2): the height that a share `ratio` (0 to 1) of the nodes exceeds. It is in mm
/// from the zero of the heights, linear between nodes, and the inverse of Smr(c).
double material_height(const Eigen::VectorXd& heights, double ratio);

/// Parameters of the material ratio curve (ISO 21920-2; ISO 13565-2). The line of least squares through the
/// flattest 40 % of the curve separates peaks, core and valleys. Among equally flat regions the first counts.
struct CoreHeights {
    double Rk = 0;  ///< core height, mm
    double Rpk = 0; ///< reduced peak height, mm: that of a triangle as large as the peaks above the core
    double Rvk = 0; ///< reduced valley depth, mm
    double Mr1 = 0; ///< share of material at the core's upper limit, 0 to 1
    double Mr2 = 0; ///< share of material at its lower limit
};
/// Takes heights at even nodes, five or more.
CoreHeights core_heights(const Eigen::VectorXd& heights);

/// Profile elements: a hill above a tenth of the largest height, then a dale below a tenth of the largest
/// depth. An element runs from one crossing of the mean line to the next but one (ISO 21920-2:
/// crossing-the-line segmentation, done from both ends).
struct ProfileElements {
    double RSm = 0; ///< mean width, mm; NaN without a whole element
    double Rc = 0;  ///< mean height, hill to dale, mm
};
/// Takes a profile about its mean line: heights (mm) whose mean is 0.
ProfileElements profile_elements(const Profile& profile);

/// Directions of a map's waves (ISO 25178-2).
struct Texture {
    /// autocorrelation length, mm. It is the distance at which the autocorrelation has fallen to 0.2, in the
    /// direction of fastest decay. NaN if it does not fall to 0.2 within half of the map
    double Sal = 0;
    /// aspect ratio, 0 to 1: Sal over that length in the direction of slowest decay. Near 0 the roughness has
    /// one direction, near 1 all directions are alike.
    double Str = 0;
    /// whether the slowest decay goes beyond half of the map, so that Str is an upper bound
    bool Str_is_bound = false;
    double Std = 0; ///< direction of the lay, degrees from x towards y, 0 to 179: grooves run along it
};
/// The texture of a levelled map. Unless the map is `periodic`, lags are averaged over the nodes that overlap
/// and the spectrum is taken under a Hann window. Directions differ by one degree. Throws InputError on fewer
/// than four nodes along a side.
Texture texture(const Profile& map, bool periodic = false);

/// Parameters of a map about its mean plane. They are Sa, Sq, Ssk, Sku, Sp, Sv, Sz, Sdq, Sdr, Sal, Str, Std,
/// Smr, Smc10, Sk, Spk, Svk, Smrk1, Smrk2. Sdq and Sdr use the seven-point formula. Smr is taken at the mean
/// plane. Smc10 is the height that a tenth of the nodes exceed.
struct ArealParameters : SurfaceParameters {
    bool Str_is_bound = false; ///< as in Texture
};
/// Takes a map whose form is removed. Throws InputError on fewer than ten nodes along a side and on a flat
/// map.
ArealParameters areal_parameters(const Profile& map, bool periodic = false);

} // namespace rough
