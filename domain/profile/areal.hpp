#pragma once

#include "domain/profile/material_ratio.hpp"

namespace rough {

/// How the waves of an area lie (ISO 25178-2).
struct Texture {
    /// autocorrelation length, mm: how far away, in the direction of fastest decay, the autocorrelation has
    /// fallen to 0.2; no number where it nowhere does within half of the area
    double Sal = 0;
    /// aspect ratio, 0 to 1: Sal over the same length in the direction of slowest decay. Near 0 one direction
    /// carries the roughness, near 1 all are alike.
    double Str = 0;
    /// whether the slowest decay reaches beyond half of the area, so that Str is at most what is given
    bool Str_is_bound = false;
    double Std = 0; ///< direction of the lay, degrees from x towards y, 0 to 179: grooves run along it
};
/// Of a levelled map. `wraps`: it repeats; otherwise lags are averaged over the nodes that overlap, and the
/// spectrum is taken under a Hann window. Directions are told apart by one degree. Throws InputError on fewer
/// than four nodes along a side.
Texture texture(const Profile& map, bool wraps = false);

/// Parameters of an areal map about its mean plane (ISO 25178-2:2021). Integrals are means over the nodes.
struct ArealParameters {
    double Sa = 0;    ///< arithmetic mean height, mm
    double Sq = 0;    ///< root mean square height, mm
    double Ssk = 0;   ///< skewness
    double Sku = 0;   ///< kurtosis, 3 for Gaussian heights
    double Sp = 0;    ///< highest peak, mm
    double Sv = 0;    ///< deepest pit, mm
    double Sz = 0;    ///< maximum height, Sp + Sv, mm
    double Sdq = 0;   ///< root mean square gradient, by the seven-point formula
    double Sdr = 0;   ///< developed area over the map's, less 1, by the same
    double Smr = 0;   ///< material ratio at the mean plane, 0 to 1
    double Smc10 = 0; ///< height above the mean plane that a tenth of the nodes exceed, mm
    CoreHeights core; ///< Sk, Spk, Svk, Smrk1, Smrk2
    Texture texture;  ///< Sal, Str, Std
};
/// Of a map whose form is taken off. Throws InputError on fewer than ten nodes along a side and on a flat
/// one.
ArealParameters areal_parameters(const Profile& map, bool wraps = false);

} // namespace rough
