#pragma once

#include "domain/profile/elements.hpp"
#include "domain/profile/material_ratio.hpp"

namespace rough {

/// Parameters of a sampled profile about its mean line (ISO 21920-2:2021, ISO 4287). Their names are those of
/// a roughness profile, the waves over lambda_c taken off; of a profile without, they are Pa, Pq and so on.
/// Integrals are means over the nodes.
struct Roughness {
    double section_length = 0; ///< mm
    Index sections = 1;        ///< whole section lengths, which together are the evaluation length
    double Ra = 0;             ///< arithmetic mean height, mm
    double Rq = 0;             ///< root mean square height, mm
    double Rsk = 0;            ///< skewness
    double Rku = 0;            ///< kurtosis, 3 for Gaussian heights
    double Rp = 0;             ///< largest height: mean over the sections of the highest peak, mm
    double Rv = 0;             ///< largest depth: mean over the sections of the deepest pit, mm
    double Rz = 0;             ///< maximum height: Rp + Rv, mm
    double Rt = 0;             ///< total height: highest to lowest, mm
    double Rmr = 0;            ///< material ratio at the mean line, 0 to 1
    ProfileElements elements;  ///< RSm and Rc
    CoreHeights core;          ///< Rk, Rpk, Rvk, Mr1, Mr2
    double Rdq = 0;            ///< root mean square gradient, by the seven-point formula
    double rms_curvature = 0;  ///< root mean square second derivative, by the seven-point formula, 1/mm
    double m0 =
        0; ///< spectral moments: mean squares of height (mm^2), gradient and second derivative (1/mm^2);
    double m2 = 0; ///< the integral of q^n C(q) over wave numbers q, rad/mm, for n = 0, 2, 4 (Nayak 1971)
    double m4 = 0; ///< as m0 and m2, n = 4, 1/mm^2
    double bandwidth = 0; ///< Nayak's alpha = m0 m4/m2^2, at least 1
};

/// Of as many whole section lengths (mm: lambda_c of a roughness profile) as the profile has, in its middle;
/// 0: the whole profile is one section. Throws InputError on fewer than ten nodes, fewer than two a section,
/// a section longer than the profile, or a constant profile.
Roughness roughness(const Profile& profile, double section_length = 0);

} // namespace rough
