#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Parameters of a sampled profile over its whole length, taken about its mean line (ISO 21920-2:2021; no
/// filter is applied: the profile is taken as the scale-limited one). Integrals are means over the nodes.
struct Roughness {
    double Ra = 0;  ///< arithmetic mean height, mm
    double Rq = 0;  ///< root mean square height, mm
    double Rsk = 0; ///< skewness
    double Rku = 0; ///< kurtosis, 3 for Gaussian heights
    double Rz = 0;  ///< maximum height: mean over five section lengths of highest peak plus deepest pit, mm
    double Rt = 0;  ///< total height: highest to lowest, mm
    double Rdq = 0; ///< root mean square gradient, by the seven-point formula
    double rms_curvature = 0; ///< root mean square second derivative, by the seven-point formula, 1/mm
    double m0 =
        0; ///< spectral moments: mean squares of height (mm^2), gradient and second derivative (1/mm^2);
    double m2 = 0; ///< the integral of q^n C(q) over wave numbers q, rad/mm, for n = 0, 2, 4 (Nayak 1971)
    double m4 = 0; ///< as m0 and m2, n = 4, 1/mm^2
    double bandwidth = 0; ///< Nayak's alpha = m0 m4/m2^2, at least 1
};

/// Throws InputError on fewer than ten nodes (two a section), or a constant profile.
Roughness roughness(const Profile& profile);

} // namespace rough
