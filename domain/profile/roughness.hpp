#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <string_view>

/// @file
/// Parameters of profiles (ISO 21920-2:2021, ISO 4287) and of areal maps (ISO 25178-2:2021). Integrals are
/// means over the nodes.
namespace rough {

/// One parameter of a surface.
struct SurfaceParameter {
    std::string name;    ///< name in the standard, e.g. "Ra" or "Sdq"
    std::string unit;    ///< "mm", "1/mm", "mm²", "1/mm²", "°" or ""
    std::string meaning; ///< meaning in a few words
    double value = 0;    ///< value in its unit; NaN if the surface has none

    /// Name and unit as a key of JSON: "Ra_mm", "m4_per_mm2", "Std_degrees".
    std::string key() const;
};

/// The parameters of a surface, in the order of the standard.
struct SurfaceParameters {
    std::vector<SurfaceParameter> rows; ///< all parameters

    /// The value of the parameter of that name. Throws InputError if it does not exist.
    double operator[](std::string_view name) const;
};

/// Parameters of a sampled profile about its mean line. They are Ra, Rq, Rsk, Rku, Rp, Rv, Rz, Rt, Rc, RSm,
/// Rdq, Rmr, Rk, Rpk, Rvk, Rmrk1, Rmrk2. If `section_length` is 0, P replaces R, because no wavelengths
/// over lambda_c were removed. Slopes and curvatures use the seven-point formula of ISO 21920-2.
///
/// Then follow the rms curvature and the spectral moments m0, m2 and m4 (mean squares of height, slope and
/// second derivative; Nayak 1971). The last is the bandwidth alpha = m0 m4/m2^2, at least 1.
struct Roughness : SurfaceParameters {
    double section_length = 0; ///< length of a section, mm
    Index sections = 1;        ///< number of sections, which together are the evaluation length
};
/// Evaluates the largest whole number of sections that fits, centred on the profile. `section_length` is in
/// mm (lambda_c of a roughness profile); 0: the whole profile is one section. Throws InputError on fewer than
/// ten nodes, fewer than two nodes per section, a section longer than the profile, or a constant profile.
Roughness roughness(const Profile& profile, double section_length = 0);

/// The material ratio Rmr(c) of a profile: the share of its length that is higher than `level` (mm, from the
/// zero of the heights). The profile is straight between its nodes. For a map Smr(c): the share of its nodes.
double material_ratio(const Profile& profile, double level);

/// The material height Smc(mr) of a map (ISO 25178-2), mm from the zero of the heights. A share `ratio` (0 to
/// 1) of the nodes is higher. It interpolates linearly between the sorted heights. Smr(c) is a step function,
/// so the result is only approximately its inverse.
double material_height(const Eigen::VectorXd& heights, double ratio);

/// Texture parameters of a map (ISO 25178-2).
struct Texture {
    /// Autocorrelation length, mm. It is the distance at which the autocorrelation has fallen to 0.2, in the
    /// direction of fastest decay. NaN if it does not fall to 0.2 within half of the map.
    double Sal = 0;
    /// Aspect ratio, 0 to 1: Sal divided by the corresponding length in the direction of slowest decay. Near
    /// 0 the roughness has one direction, near 1 all directions are alike.
    double Str = 0;
    /// True if, in the direction of slowest decay, the autocorrelation is still above 0.2 at half of the map.
    /// Str is then an upper bound.
    bool Str_is_bound = false;
    double Std = 0; ///< direction of the grooves, degrees from x towards y, 0 to 179
};
/// The texture of a levelled map. Unless the map is `periodic`, each lag is averaged over the nodes that
/// overlap, and the spectrum is computed under a Hann window. Directions are tried in steps of one degree.
/// Throws InputError on fewer than four nodes along a side.
Texture texture(const Profile& map, bool periodic = false);

/// Parameters of a map about its mean plane. They are Sa, Sq, Ssk, Sku, Sp, Sv, Sz, Sdq, Sdr, Sal, Str, Std,
/// Smr, Smc10, Sk, Spk, Svk, Smrk1, Smrk2. Sdq uses the seven-point formula, Sdr the triangles between the
/// nodes. Smr is taken at the mean plane. Smc10 is the height that a tenth of the nodes exceed.
struct ArealParameters : SurfaceParameters {
    bool Str_is_bound = false; ///< as in Texture
};
/// The parameters of a map without form. Throws InputError on under ten nodes along a side and on a flat map.
ArealParameters areal_parameters(const Profile& map, bool periodic = false);

} // namespace rough
