#pragma once

#include "domain/theory/theory.hpp"

namespace rough {

/// Persson's theory (2001, J. Chem. Phys. 115, 3840; 2007, Phys. Rev. Lett. 99, 125502): the pressure's
/// distribution spreads as ever shorter waves are seen, and is cut off at zero. A/A0 = erf(sqrt 2 P/(E* h'))
/// at every load, of profiles and areas, as the pressure of full contact varies by E* h'/2 in both. Stiffness
/// from the elastic energy, with s = sqrt 2 P/(E* h'(q)), h'(q) the slope of waves up to q: 1/K = 1/(sqrt(2
/// pi) P) int q/h'(q) [gamma + 3 (1 - gamma) erf^2 s] exp(-s^2) dm0, gamma = 0.45 for what contact does not
/// reach (Yang & Persson 2008, J. Phys.: Condens. Matter 20, 215214; 1 in 2007). Exact at full contact;
/// K is best at middle loads, where it is near P/u0, and a finite surface is softer at light ones.
TheoryCurve persson(const RandomSurface& surface, double effective_modulus, const Eigen::VectorXd& pressures);

/// u0 of P ~ exp(-u/u0), K = P/u0 as P -> 0, mm: gamma/sqrt(2 pi) int q/h'(q) dm0, about half the root mean
/// square height.
double persson_length(const RandomSurface& surface);

} // namespace rough
